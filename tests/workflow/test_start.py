"""What is refused before anything starts, each in one line."""

import shutil
import subprocess
import sys

import pytest


def test_a_bad_config_is_a_line_a_mistake_and_starts_nothing(tree):
    tree.edit("fig5", energy=0.9)
    tree.edit("fig7", impact=3)
    lines = (
        "config.yaml: scenes.fig5.energy: 0.9 is not allowed: expected a number below "
        "k/2 - g = 0.06, where the ball could flatten to nothing\n"
        "config.yaml: scenes.fig7.impact: unknown key: did you mean impacts?\n"
    )
    result = tree.run()
    assert (result.returncode, result.stdout) == (1, lines)
    bare = subprocess.run(
        [*tree.command()[:1], "-m", "snakemake", "-n"],
        cwd=tree.path,
        env=tree.environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (bare.returncode, bare.stderr) == (1, lines)
    assert not (tree.path / "results").exists()


def test_settings_on_the_command_line_are_refused(tree):
    result = tree.run("-n", "--config", "energy=0.3")
    assert result.returncode == 2
    assert result.stdout.splitlines()[-1].endswith("not used here: edit config.yaml")


def shell_tools(folder, *tools):
    """A folder with nothing on it but these tools."""
    folder.mkdir()
    for tool in ("readlink", "cat", "cksum", "uname", "cut", "tail", "mkdir", "rm", *tools):
        (folder / tool).symlink_to(shutil.which(tool))
    return folder


@pytest.mark.parametrize(
    ("pretend", "line"),
    [
        (None, "no python3 found: please install Python 3.11 or newer"),
        (
            "sys.version_info = (3, 9, 2)",
            "needs Python 3.11 or newer, but python3 is 3.9.2",
        ),
        (
            "sys.modules['ensurepip'] = None",
            "python3 lacks the venv module: "
            "please install it (Debian, Ubuntu: apt install python3-venv)",
        ),
        (
            "sys.version_info = (3, 14, 0)",
            "python3 is 3.14.0, for which one package has to be compiled: please install a C "
            "compiler and Python's headers (Debian, Ubuntu: apt install gcc python3-dev), or "
            "Python 3.11 to 3.13",
        ),
    ],
)
def test_an_unsuitable_python_is_one_line(tree, tmp_path, pretend, line):
    path = shell_tools(tmp_path / "bin", "sh")
    if pretend:
        told = "import platform\nplatform.python_version = lambda: '.'.join(map(str, version))\n"
        prelude = (
            f"import sys\n{pretend}\nversion = sys.version_info[:3]\n{told}exec(sys.argv.pop())"
        )
        program = tmp_path / "program.py"
        program.write_text(prelude)
        (path / "python3").write_text(f'#!/bin/sh\nexec "{sys.executable}" "{program}" "$2"\n')
        (path / "python3").chmod(0o755)
    result = subprocess.run(
        [str(tree.path / "reproduce")],
        env={"PATH": str(path)},
        cwd="/",
        capture_output=True,
        text=True,
        check=False,
    )
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == f"reproduce: {line}\n"
    assert not (tree.path / ".venv").exists()
