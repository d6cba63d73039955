"""ruff, mypy, snakefmt and the linter of snakemake pass; the pinned versions agree."""

import re
import shutil
import sys

import pytest

from helpers.project import ROOT, run
from helpers.requirements import requested

PYTHON = (sys.executable, "-m")


def succeed(*command, cwd=ROOT):
    result = run(*command, cwd=cwd)
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("check", [["check"], ["format", "--check"]])
def test_ruff(check):
    succeed(*PYTHON, "ruff", *check, "--no-cache", ".")


@pytest.mark.slow
def test_mypy():
    succeed(*PYTHON, "mypy")


def test_snakefmt():
    succeed(*PYTHON, "snakefmt", "--check", "Snakefile", "workflow")


@pytest.mark.slow
def test_snakemake_lint():
    """The environment is requirements/, and no rule names one; nothing else is complained about."""
    result = run(*PYTHON, "snakemake", "--lint", cwd=ROOT)
    complaints = {*re.findall(r"^    \* (.*?):?$", result.stderr, re.MULTILINE)}
    allowed = "Specify a conda environment or container for each rule."
    assert complaints == {allowed}, result.stderr


def test_no_setting_of_git_changes_a_file(tmp_path):
    shutil.copy(ROOT / ".gitattributes", tmp_path)
    succeed("git", "init", "-q", cwd=tmp_path)
    files = ("reproduce", "config.yaml", "paper_figures/fig3.svg")
    attributes = run("git", "check-attr", "text", *files, cwd=tmp_path).stdout
    assert attributes.splitlines() == [f"{file}: text: unset" for file in files]


def pins(path):
    """Name -> version of every `name==version` in a file."""
    text = (ROOT / path).read_text()
    return dict(re.findall(r"^[ -]*([\w.-]+)==([^\s;\\]+)", text, re.MULTILINE))


def test_every_package_is_pinned_and_hashed():
    for file in (ROOT / "requirements").glob("*.txt"):
        text = file.read_text()
        entries = re.split(r"^(?=[a-z0-9])", text, flags=re.MULTILINE)[1:]
        assert len(entries) == len(pins(file)) > 0
        assert all("--hash=sha256:" in entry for entry in entries)
        assert "://" not in text


REQUESTED = sorted(file.stem for file in (ROOT / "requirements").glob("*.in"))


@pytest.mark.parametrize("name", REQUESTED)
def test_the_locks_hold_the_requested_packages(name):
    locked = pins(f"requirements/{'lock' if name == 'main' else name}.txt")
    for package, version in requested(name).items():
        assert locked[package].startswith(version)


def test_a_package_has_the_same_version_in_all_lists():
    known = {}
    own = {ROOT / "requirements" / "wheel.txt"}  # an environment apart, whose tools must be newer
    for file in sorted({*(ROOT / "requirements").glob("*.txt")} - own):
        for package, version in pins(file).items():
            assert known.setdefault(package, version) == version, (file, package)
