"""ruff, mypy, snakefmt and the linter of snakemake pass; the pinned versions agree."""

import re
import shutil
import sys

import pytest
from project import ROOT, run

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
    result = run(*PYTHON, "snakemake", "--lint", cwd=ROOT)
    assert (result.returncode, "Congratulations" in result.stderr) == (0, True), result.stderr


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


@pytest.mark.parametrize(
    ("requested", "lock"),
    [("main", "lock"), ("test", "test"), ("explorer", "explorer"), ("wheel", "wheel")],
)
def test_the_locks_hold_the_requested_packages(requested, lock):
    locked = pins(f"requirements/{lock}.txt")
    for line in (ROOT / "requirements" / f"{requested}.in").read_text().splitlines():
        if line and not line.startswith("#"):
            pin = line.partition(";")[0].strip()  # without its condition
            name, _, version = pin.lower().replace("_", "-").partition("==")
            assert locked[name].startswith(version)


def test_additional_packages_have_the_versions_of_the_lock():
    locked = pins("requirements/lock.txt")
    for file in ("test", "study", "slurm", "explorer", "site"):
        pinned = pins(f"requirements/{file}.txt")
        assert pinned and {name: locked.get(name, pinned[name]) for name in pinned} == pinned
    locked |= pins("requirements/study.txt")
    conda = pins("workflow/envs/python.yaml")
    assert conda and {name: locked[name] for name in conda} == conda
