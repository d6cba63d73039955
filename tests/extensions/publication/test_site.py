"""./reproduce site and article: what is not as committed is not published, nothing is deleted."""

import json
import re
from contextlib import nullcontext
from pathlib import Path

import pytest
from archives import DATA, forge
from project import ROOT
from report_pages import rendered

from extensions.explorer import page as explorer
from extensions.publication.article import numbers
from extensions.publication.commands import article, site
from pipeline import config
from pipeline.cli import figures
from pipeline.cli.arguments import Arguments
from pipeline.cli.session import UsageError


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
    with pytest.raises(ValueError, match=re.escape(f"{name} was not written by this command")):
        site._refuse_others(tmp_path)


@pytest.mark.parametrize("command", [site, article])
def test_results_that_are_not_the_committed_ones_are_named_and_not_published(
    command, moved, monkeypatch
):
    """One was edited by hand: its record fits, only the manifest tells."""
    forge(moved, DATA)
    monkeypatch.setattr(command, "ROOT", moved.path)
    monkeypatch.setattr(command, "locked", nullcontext)
    monkeypatch.setattr(figures, "make", lambda *_: 0)
    args = Arguments(config=config.load(moved.config), dry_run=False, options=[])
    name = command.__name__.rpartition(".")[2]
    with pytest.raises(UsageError, match=rf"^{name}: [^\n]*{DATA}[^\n]*$"):
        command.run(args)
    assert not [*(moved.path / "results").glob("*site*"), *moved.path.glob("results/article*")]


def test_a_site_that_cannot_be_replaced_stays(tmp_path):
    write(tmp_path, "site/report.html")
    with pytest.raises(FileNotFoundError):
        site._replace(tmp_path / ".site.part", tmp_path / "site")
    assert [str(f.relative_to(tmp_path)) for f in tmp_path.rglob("*.html")] == ["site/report.html"]


@pytest.mark.slow
def test_the_links_of_the_site_lead_to_its_files_and_the_explorer_may_be_anywhere(reported):
    """The explorer's page is in results/, in the site, in archives and where people copy it."""
    explorer_page = (ROOT / explorer.COPY).read_text(encoding="utf-8")
    stored = re.search(r'<script type="application/json" id="data">(.*?)</script>', explorer_page)
    data = json.loads(stored[1])["citation"]["links"].values()
    fixed = re.findall(r'<a [^>]*href="?([^">\s]+)', explorer_page.partition("<script")[0])
    assert all(link.startswith(("#", "https://", "data:")) for link in (*data, *fixed))
    files = {"report.html", "explorer.html", "article.html", "article.pdf"}
    with_report = rendered(reported, beside=site._BESIDE)
    source = (Path(numbers.__file__).parent / "template.typ").read_text()
    pages = {
        "index": re.findall('href="([^"]*)"', site._INDEX.read_text()),
        "explorer": re.findall('href="([^"]*)"', site._LINKS),
        "report": re.findall(r'<a [^>]*href="([^"]*)"', with_report),
        "article": re.findall(r'link\("([\w.]+html|[\w.]+pdf)', source),
    }
    for links in pages.values():
        relative = {link.partition("#")[0] for link in links} - {""}
        assert relative and {x for x in relative if not x.startswith("paper/")} <= files
