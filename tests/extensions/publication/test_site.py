"""./reproduce site: the folder is replaced whole, and nothing of a user is deleted."""

import re
from contextlib import nullcontext

import pytest
from project import SHIPPED

from extensions.publication.commands import site
from pipeline import config
from pipeline.cli.arguments import Arguments
from pipeline.cli.commands import clean


def write(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)


def test_a_new_folder_replaces_the_old_one(tmp_path):
    folder, part = tmp_path / "site", tmp_path / ".site.1.part"
    write(folder, "report.html", "paper/orbits_gone.nc")
    write(part, "report.html", "paper/orbits_fig2.nc")
    site._replace(part, folder)
    files = {str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*") if file.is_file()}
    assert files == {"site/report.html", "site/paper/orbits_fig2.nc"}


@pytest.mark.parametrize("name", ["mine.txt", "paper/mine.txt", "more/report.html"])
def test_a_file_that_the_command_did_not_write_is_refused(tmp_path, name):
    write(tmp_path, "report.html", "article.pdf", "paper/orbits_fig2.nc")
    site._refuse_others(tmp_path)
    write(tmp_path, name)
    with pytest.raises(ValueError, match=re.escape(f"{name} is not of this command")):
        site._refuse_others(tmp_path)


def test_without_committed_figures_no_site_is_written(moved):
    (moved.path / "paper_figures" / "SHA256SUMS").unlink()
    result = moved.run("site")
    assert result.returncode == 1
    assert "reproduce: site: " in result.stdout
    assert not list((moved.path / "results").glob("*site*"))


def test_clean_deletes_what_was_published_and_nothing_else(tmp_path, monkeypatch):
    monkeypatch.setattr(clean, "ROOT", tmp_path)
    monkeypatch.setattr(clean, "RESULTS", tmp_path / "results")
    monkeypatch.setattr(clean, "locked", nullcontext)
    mine = {"site/mine.txt", "archive/mine.tar"}
    ours = {
        *("article.pdf", "site/report.html", "site/paper/orbits_fig2.nc"),
        ".site.77.part/paper/orbits_fig2.nc",  # its run was killed
        "archive/pseudorigid-python3.13-x86_64.tar",
    }
    write(tmp_path / "results", *mine, *ours)
    assert clean.run(Arguments(folder=[], yes=True, config=config.load(SHIPPED))) == 0
    files = {str(f.relative_to(tmp_path / "results")) for f in tmp_path.rglob("*") if f.is_file()}
    assert files == mine
