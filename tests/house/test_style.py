"""The tools that keep the tree tidy find nothing, and the pins agree with each other."""

import re
import shutil
import subprocess
import sys

import pytest
from project import ROOT


def silent(*command):
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("check", [["check"], ["format", "--check"]])
def test_ruff(check):
    silent(sys.executable, "-m", "ruff", *check, "--no-cache", ".")


def test_snakefmt():
    silent(sys.executable, "-m", "snakefmt", "--check", "Snakefile", "workflow")


def test_snakemake_lint(tree):
    result = tree.run("--lint")
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize("shell", ["sh", "dash", "bash"])
def test_the_shell_can_read_reproduce(shell):
    if shutil.which(shell) is None:
        pytest.skip(f"no {shell} here")
    silent(shell, "-n", "reproduce")


def pins(path):
    """Name -> version of every `name==version` in a file."""
    text = (ROOT / path).read_text()
    return dict(re.findall(r"^[ -]*([\w.-]+)==([^\s;\\]+)", text, re.MULTILINE))


def test_every_package_is_pinned_and_hashed():
    for name in ("build.txt", "lock.txt"):
        text = (ROOT / "requirements" / name).read_text()
        entries = re.split(r"^(?=[a-z0-9])", text, flags=re.MULTILINE)[1:]
        assert len(entries) == len(pins(f"requirements/{name}"))
        assert all("--hash=sha256:" in entry for entry in entries)
        assert "://" not in text


def test_the_lock_holds_what_is_asked_for():
    locked = pins("requirements/lock.txt")
    for line in (ROOT / "requirements" / "main.in").read_text().splitlines():
        if line and not line.startswith("#"):
            name, _, version = line.lower().partition("==")
            assert locked[name].startswith(version)


def test_the_conda_environment_has_the_versions_of_the_lock():
    locked = pins("requirements/lock.txt")
    wanted = pins("workflow/envs/python.yaml")
    assert wanted
    assert {name: locked[name] for name in wanted} == wanted
