"""A plain snakemake makes the files of ./reproduce, in any environment with the packages."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from helpers.project import of_scenes, run
from helpers.slowly import slowly

SITE = Path(np.__file__).parents[1]  # the packages, without the link to the sources in .venv


def snakemake(folder, *arguments):
    """Run snakemake in a folder, by a Python that finds the packages and no sources."""
    others = {n: v for n, v in os.environ.items() if not n.startswith(("PYTHON", "SNAKEMAKE"))}
    command = [sys.executable, "-S", "-m", "snakemake", "--cores", "1", *arguments]
    return run(*command, cwd=folder, env=others | {"PYTHONPATH": str(SITE)})


@pytest.mark.slow
def test_it_makes_the_same_files_where_no_environment_knows_the_sources(tree):
    tree.write(of_scenes("fig7"))
    # The Python of the jobs finds the sources of the tests too.
    tree.append("pseudorigid/dynamics/lyapunov.py", "open('loaded here', 'w').close()\n")
    result = snakemake(tree.path)
    assert result.returncode == 0, result.stderr
    assert (tree.path / "loaded here").exists()
    drawn = (tree.path / "results/paper/figures/fig7.png").read_bytes()
    assert (tree.path / "paper_figures/fig7.png").read_text() == "committed"
    tree.succeed()  # publishes what is there
    assert not list((tree.path / ".snakemake" / "log").glob("*reproduce*"))
    assert (tree.path / "paper_figures/fig7.png").read_bytes() == drawn
    assert "Nothing to be done" in snakemake(tree.path).stderr


MODULE = 'module ball:\n    snakefile: "{}/Snakefile"\n\nuse rule * from ball as ball_*\n'


@pytest.mark.parametrize(
    "where", ["another folder", *slowly("its own folder", "another directory")]
)
def test_use_as_a_module_or_with_a_directory_is_refused_in_one_line(tree, tmp_path, where):
    tree.write(of_scenes("fig7"))
    other = tmp_path / "other"
    other.mkdir()
    folder = tree.path if where == "its own folder" else other
    arguments = ["--directory", str(other)]
    if where != "another directory":
        (folder / "mine.smk").write_text(MODULE.format(tree.path))
        arguments = ["-s", "mine.smk", "ball_orbits"]
    result = snakemake(tree.path if where == "another directory" else folder, *arguments)
    words = "in its own folder, not as a module and without --directory"
    line = f"reproduce: the workflow runs {words}: copy {tree.path} to have results elsewhere"
    assert (result.returncode, result.stderr.splitlines()[-1]) == (1, line)
    assert not (tree.path / "results").exists() and not (other / "results").exists()
