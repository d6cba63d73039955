"""What is refused before anything starts, each in one line."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
from project import ROOT

from pipeline.cli import running
from pipeline.cli.folder import MisuseError


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


def test_the_code_of_one_tree_does_not_run_the_workflow_of_another(tree):
    """As when a job of a cluster finds another checkout's packages first."""
    result = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1"],
        cwd=tree.path,
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    line = f"reproduce: this is {tree.path}, but the code of {ROOT} runs: use ./reproduce here\n"
    assert (result.returncode, result.stderr) == (1, line)
    assert not (tree.path / "results").exists()


def test_settings_on_the_command_line_are_refused(tree):
    result = tree.run("-n", "--config", "energy=0.3")
    assert result.returncode == 2
    assert result.stdout.splitlines()[-1].endswith("not used here: edit config.yaml")


@pytest.mark.parametrize(
    "words", ["--cors 1", "--cores x", "-j x", "--set-threads x", "--default-resources ="]
)
def test_what_snakemake_cannot_read_is_one_line(words):
    with pytest.raises(MisuseError) as refused:
        running.options_of(words.split())
    assert len(str(refused.value).splitlines()) == 1


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


STAND_IN = """#!/bin/sh
case "$*" in
*pipeline.cli.arguments*) exit 75 ;;
*sys.version_info\\[:2]*) echo 3 11 ;;
'-m venv '*) mkdir -p "$3/bin"; cp "$0" "$3/bin/python"; echo "command = $*" >"$3/pyvenv.cfg" ;;
*'-m pip '*) [ ! -e "$SLOW" ] || { touch "$SLOW.begun"; exec sleep 60; } ;;
*'-m pipeline'*) echo "handed over$PYTHONWARNINGS" ;;
esac
"""


class SetUp:
    """A tree whose interpreter installs nothing."""

    def __init__(self, tree, folder):
        self.venv, self.slow = tree.path / ".venv", folder / "slow"
        (folder / "bin").mkdir()
        (folder / "bin" / "python3").write_text(STAND_IN)
        (folder / "bin" / "python3").chmod(0o755)
        path = f"{folder / 'bin'}:{os.environ['PATH']}"
        self.how = {
            "args": [str(tree.path / "reproduce")],
            "env": os.environ
            | {"PATH": path, "SLOW": str(self.slow), "TMPDIR": str(folder)}
            | {"PYTHONWARNINGS": "error"},  # must not reach what runs
            "text": True,
        }
        self.folder = folder

    def run(self):
        result = subprocess.run(**self.how, capture_output=True, check=False)
        return result.returncode, result.stdout + result.stderr


@pytest.fixture
def set_up(tree, tmp_path):
    return SetUp(tree, tmp_path)


MADE = (
    0,
    "handed over\nreproduce: installing the locked packages into .venv (once, about a minute)\n",
)


def test_what_is_left_of_a_venv_is_made_anew(set_up):
    assert set_up.run() == MADE
    assert set_up.run() == (0, "handed over\n")
    for gone in (["stamp"], ["install.log", "stamp"], ["install.log", "stamp", "pyvenv.cfg"]):
        for name in gone:
            (set_up.venv / name).unlink()
        assert set_up.run() == MADE, gone
    shutil.rmtree(set_up.venv)
    set_up.venv.mkdir()
    assert set_up.run() == MADE
    assert not list(set_up.folder.glob("tmp*"))


def test_a_venv_of_somebody_else_stays(set_up):
    set_up.run()
    (set_up.venv / "install.log").unlink()
    (set_up.venv / "stamp").unlink()
    line = f"reproduce: {set_up.venv} was not made by ./reproduce: please move it away\n"
    for name, text in (("conda-meta", ""), ("pyvenv.cfg", "command = python3 -m venv .venv")):
        (set_up.venv / name).write_text(text)
        assert set_up.run() == (1, line), name
        (set_up.venv / name).unlink()
    kept = set_up.venv.rename(set_up.folder / "kept")
    for name in ("file", "link", "folder"):
        if name == "file":
            set_up.venv.write_text("mine")
        elif name == "link":
            set_up.venv.symlink_to(kept)
        else:
            set_up.venv.mkdir()
            (set_up.venv / "bin").mkdir()
        assert set_up.run() == (1, line), name
        if name != "folder":
            set_up.venv.unlink()
    assert (kept / "bin" / "python").is_file()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_set_up_ends_when_its_shell_alone_is_told(set_up, number):
    set_up.slow.touch()
    run = subprocess.Popen(
        **set_up.how,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),  # noqa: PLW1509
    )
    for _ in range(600):
        if (set_up.folder / "slow.begun").exists():
            break
        time.sleep(0.1)
    run.send_signal(number)
    _, said = run.communicate(timeout=30)
    assert run.returncode == 130
    assert said.splitlines()[1:] == ["reproduce: interrupted: run it again to go on"]
    set_up.slow.unlink()
    assert set_up.run() == MADE
