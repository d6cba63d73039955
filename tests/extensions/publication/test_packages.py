"""The locked packages as files: the right ones for a machine, and damaged ones refused."""

import os
import platform
import re
import shutil
import subprocess
import sys

import pytest

from extensions.publication import archive
from extensions.publication.commands import archive as command
from helpers.project import ROOT, run
from pipeline import config
from pipeline.cli.errors import UsageError

PYTHON = ".".join(platform.python_version_tuple()[:2])


@pytest.mark.parametrize("python", ["3.11", "3.13"])
def test_the_conditions_of_requirements_are_those_of_the_other_python(
    python, tmp_path, monkeypatch
):
    target = {"python_version": python, "python_full_version": f"{python}.0"}
    lines = command.requirements_for("lock", target)
    names = [line.partition("==")[0] for line in lines]
    assert "greenlet" in names and "pyreadline3" not in names
    assert all(" --hash=sha256:" in line and ";" not in line for line in lines)
    conditions = "a==1 ; python_version < '3.12'\nb==1 ; python_full_version < '3.12'\n"
    (tmp_path / "requirements").mkdir()
    (tmp_path / "requirements" / "lock.txt").write_text(conditions)
    monkeypatch.setattr(command, "ROOT", tmp_path)
    assert len(command.requirements_for("lock", target)) == (2 if python == "3.11" else 0)


@pytest.mark.slow
def test_an_archive_with_packages_is_made_twice_and_refuses_a_damaged_one(accepted, tmp_path):
    tree = accepted.copy(tmp_path / "tree")
    shutil.copy(ROOT / ".gitignore", tree.path)
    for words in (["init", "-q"], ["add", "."]):
        subprocess.run(["git", "-C", tree.path, *words], check=True)
    checked, sums = config.load(tree.config), []
    for name in ("one.tar", "two.tar"):
        try:
            packages = command.download(tmp_path / f"packages of {name}", PYTHON)
        except UsageError as error:
            pytest.skip(str(error))
        sums.append(archive.write(tree.path, checked, tmp_path / name, packages))
    assert sums[0] == sums[1]
    assert (tmp_path / "one.tar").stat().st_size < 300e6
    subprocess.run(["tar", "-xf", "one.tar"], cwd=tmp_path, check=True)
    folder = tmp_path / archive.TOP
    (wheel,) = (folder / archive.PACKAGES).glob("numpy-*.whl")
    whole = wheel.read_bytes()
    wheel.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
    path = f"{os.path.dirname(sys.executable)}{os.pathsep}{os.environ['PATH']}"
    result = run(folder / "reproduce", env={"PATH": path, "HOME": str(tmp_path)}, cwd="/")
    assert result.returncode == 1
    assert re.search(r"packages: numpy\S* is damaged: ", result.stderr.splitlines()[-1])
