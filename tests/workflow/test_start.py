"""Refusals before anything starts, and the installation of .venv."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from base64 import urlsafe_b64encode
from hashlib import sha256
from pathlib import Path

import pytest
from project import ROOT

from pipeline.cli import running
from pipeline.cli.session import CommandLineError


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
    profile, message = bare.stderr.split("\n", 1)
    assert (bare.returncode, message) == (1, lines)
    assert "profiles/default" in profile
    assert not (tree.path / "results").exists()


def test_the_code_of_one_tree_does_not_run_the_workflow_of_another(tree):
    """On a cluster, a job could import the packages of another checkout."""
    result = subprocess.run(
        [sys.executable, "-m", "snakemake", "--cores", "1"],
        cwd=tree.path,
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=False,
    )
    line = f"reproduce: this is {tree.path}, but the code of {ROOT} runs: use ./reproduce here\n"
    assert (result.returncode, result.stderr.split("\n", 1)[1]) == (1, line)
    assert not (tree.path / "results").exists()


@pytest.mark.parametrize(
    "words", ["--coers 1", "--cores x", "-j x", "--set-threads x", "--default-resources ="]
)
def test_a_bad_option_of_snakemake_is_one_line(words):
    with pytest.raises(CommandLineError) as refused:
        running.options_of(words.split())
    (line,) = str(refused.value).splitlines()
    assert ("did you mean --cores?" in line) == (words == "--coers 1")


@pytest.mark.parametrize("option", ["--directory", "-d", "--direct"])
def test_options_for_another_folder_are_refused(option):
    with pytest.raises(CommandLineError, match=r"^--directory is not used here"):
        running.options_of(["fig3", option, "elsewhere"])


def shell_tools(folder, *tools):
    """Return a folder for PATH with only a few tools."""
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
        version = "import platform\nplatform.python_version = lambda: '.'.join(map(str, version))\n"
        prelude = (
            f"import sys\n{pretend}\nversion = sys.version_info[:3]\n{version}exec(sys.argv.pop())"
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


LINE = "reproduce: installing the locked packages into .venv (once)\n"
MADE = (0, f"handed over\n{LINE}")
UV = ROOT / ".venv" / "bin" / "uv"
# A uv of the right version whose installations succeed, slowly if the file SLOW is there.
SLOW_UV = """#!/bin/sh
[ "$1" != --version ] || { echo uv %s; exit; }
[ ! -e "$SLOW" ] || { echo $$ >"$SLOW.pid"; exec sleep 60; }
exit 1
"""


def wheel(folder, name):
    """Write a wheel of a module, `name`, with a script that prints where it runs."""
    info = f"{name}-1.0.dist-info"
    files = {
        f"{name}/__init__.py": "import sys\ndef main(): print(sys.prefix, *sys.argv[1:])\n",
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{info}/entry_points.txt": f"[console_scripts]\n{name}-where = {name}:main\n",
    }
    record = f"{info}/RECORD"
    lines = "".join(
        f"{file},sha256={urlsafe_b64encode(sha256(text.encode()).digest()).decode().rstrip('=')},"
        f"{len(text)}\n"
        for file, text in files.items()
    )
    files[record] = f"{lines}{record},,\n"
    file = folder / f"{name}-1.0-py3-none-any.whl"
    with zipfile.ZipFile(file, "w") as archive:
        for path, text in files.items():
            archive.writestr(path, text)
    return f"{name}==1.0 --hash=sha256:{sha256(file.read_bytes()).hexdigest()}\n"


class SetUp:
    """A tree that installs three small packages and prints a line instead of making figures."""

    def __init__(self, tree, folder):
        self.tree, self.venv, self.folder = tree.path, tree.path / ".venv", folder
        self.wheels = folder / "a folder, $HOME's"
        self.wheels.mkdir()
        for name, package in (("build", "tools"), ("lock", "needed"), ("test", "extra")):
            file = self.tree / "requirements" / f"{name}.txt"
            file.write_text(wheel(self.wheels, package))
        printed = "*sys.argv[1:], *sys.warnoptions, *['no caches'] * sys.dont_write_bytecode"
        main = f"import sys\nprint('handed over', {printed})\n"
        (self.tree / "src" / "pipeline" / "__main__.py").write_text(main)
        (folder / "bin").mkdir()
        (folder / "tmp").mkdir()
        self.slow = folder / "slow"
        self.environment = {
            "HOME": str(folder),
            "PATH": f"{folder / 'bin'}:{Path(sys.base_prefix) / 'bin'}:/usr/bin:/bin",
            "PSEUDORIGID_WHEELS": str(self.wheels),
            "TMPDIR": str(folder / "tmp"),
            "SLOW": str(self.slow),
            "PYTHONWARNINGS": "error",  # neither may reach python -m pipeline
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    def with_uv(self, text=None):
        """Put a uv onto PATH: the one of this .venv, or a script."""
        if text is None and not UV.exists():
            pytest.skip("uv has no wheel for this machine")
        file = self.folder / "bin" / "uv"
        if text is None:
            file.symlink_to(UV)
        else:
            file.write_text(text)
            file.chmod(0o755)

    def run(self, *arguments, **environment):
        result = subprocess.run(
            [str(self.venv.parent / "reproduce"), *arguments],
            env=self.environment | environment,
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        return result.returncode, result.stdout + result.stderr

    def shell(self, command, shell="sh"):
        """Return what a command prints in a shell, in the folder of the tree."""
        result = subprocess.run(
            [shell, "-c", command],
            env={"PATH": "/usr/bin:/bin", "HOME": str(self.folder)},
            cwd=self.venv.parent,
            capture_output=True,
            text=True,
            check=False,
        )
        return result.stdout + result.stderr

    @property
    def site(self):
        (site,) = self.venv.glob("lib/python3*/site-packages")
        return site

    def installer(self, package="needed"):
        return (self.site / f"{package}-1.0.dist-info" / "INSTALLER").read_text().strip()


@pytest.fixture
def set_up(tree, tmp_path):
    return SetUp(tree, tmp_path)


@pytest.mark.slow
def test_an_incomplete_venv_is_made_anew(set_up):
    set_up.with_uv()
    assert set_up.run() == MADE
    assert set_up.installer() == "uv"
    assert set_up.run() == (0, "handed over\n")
    for gone in (["stamp"], ["install.log", "stamp"], ["install.log", "stamp", "pyvenv.cfg"]):
        for name in gone:
            (set_up.venv / name).unlink()
        assert set_up.run() == MADE, gone
    shutil.rmtree(set_up.venv)
    set_up.venv.mkdir()
    assert set_up.run() == MADE
    assert not list((set_up.folder / "tmp").iterdir())
    (set_up.tree / "requirements" / "lock.txt").write_text(wheel(set_up.wheels, "other"))
    assert set_up.run() == MADE
    assert not (set_up.site / "needed").exists()


@pytest.mark.slow
def test_a_venv_whose_python_does_not_start_is_made_anew(set_up):
    set_up.with_uv()
    set_up.run()
    line = "reproduce: the Python of .venv does not start: making .venv again\n"
    for how in ("a broken link", "an empty folder", "no Python"):
        python = set_up.venv / "bin" / "python"
        if how == "an empty folder":
            shutil.rmtree(python.parent)
            python.parent.mkdir()
        else:
            python.unlink()
            python.symlink_to("nowhere" if how == "a broken link" else "/bin/false")
        assert set_up.run() == (0, f"handed over\n{line}"), how
        assert set_up.run() == (0, "handed over\n"), how


def test_a_venv_of_somebody_else_stays(set_up):
    set_up.with_uv()
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


def start_slowly(set_up, number):
    """Start ./reproduce with an installer that sleeps; return it and the process id."""
    (version,) = re.findall(r"^uv==(\S+)", (ROOT / "requirements/uv.txt").read_text(), re.MULTILINE)
    set_up.with_uv(SLOW_UV % version)
    set_up.slow.touch()
    run = subprocess.Popen(
        [str(set_up.tree / "reproduce")],
        env=set_up.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),  # noqa: PLW1509
    )
    pid = set_up.folder / "slow.pid"
    for _ in range(600):
        if pid.exists() and pid.read_text().strip():
            break
        time.sleep(0.1)
    return run, int(pid.read_text())


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_to_the_set_up_ends_its_installer(set_up, number):
    run, installer = start_slowly(set_up, number)
    run.send_signal(number)
    _, output = run.communicate(timeout=30)
    assert run.returncode == 130
    assert output == f"{LINE}reproduce: interrupted: run it again to go on\n"
    assert not Path(f"/proc/{installer}").exists()
    assert not list((set_up.folder / "tmp").iterdir())


@pytest.mark.slow
def test_the_installer_of_a_killed_set_up_is_waited_for(set_up):
    run, installer = start_slowly(set_up, signal.SIGINT)
    run.kill()
    run.communicate()
    set_up.slow.unlink()
    next_one = subprocess.Popen(
        run.args, env=set_up.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    with pytest.raises(subprocess.TimeoutExpired):
        next_one.communicate(timeout=2)
    os.kill(installer, signal.SIGKILL)
    out, output = next_one.communicate(timeout=60)
    assert out == "handed over\n"
    assert set_up.installer() == "pip"  # since this uv fails
    assert output == f"reproduce: waiting for another ./reproduce in this folder to end\n{LINE}"


INSTALLERS = ["uv", pytest.param("pip", marks=pytest.mark.slow)]
NAMES = ("plain", 'it\'s "$HOME" `here`; a\\b', "with a\nnewline")
SHELLS = {"sh": ".", "dash": ".", "bash": "source", "zsh": "source", "fish": "source"}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("installer", INSTALLERS)
def test_the_venv_works_as_any_other_in_any_folder_and_moved(set_up, name, installer):
    if installer == "uv":
        set_up.with_uv()
    for folder in (name, "moved"):
        place = set_up.folder / "x" / folder
        place.parent.mkdir(exist_ok=True)
        set_up.venv.parent.rename(place)
        set_up.venv = place / ".venv"
        if folder == "moved":
            assert set_up.shell(".venv/bin/needed-where") == f"{set_up.venv}\n"
            output = set_up.shell(". .venv/bin/activate; echo $?")
            assert output.startswith("1\nreproduce: this folder has moved: ")
            assert set_up.run() == (0, "handed over\n")
        else:
            assert set_up.run() == MADE
            assert set_up.installer() == installer
        assert set_up.shell(".venv/bin/needed-where 'a b'") == f"{set_up.venv} a b\n"
        for shell, word in SHELLS.items():
            if shutil.which(shell, path="/usr/bin:/bin"):
                script = f"./.venv/bin/activate{'.fish' * (shell == 'fish')}"
                output = set_up.shell(f"{word} {script}; needed-where; command -v python", shell)
                assert output == f"{set_up.venv}\n{set_up.venv}/bin/python\n", shell
    output = set_up.shell(".venv/bin/python -c 'import pipeline; print(*pipeline.__path__)'")
    assert output == f"{set_up.venv.parent}/src/pipeline\n"


def test_a_folder_that_path_cannot_hold_says_so(set_up):
    set_up.with_uv()
    place = set_up.tree.rename(set_up.folder / "a:b")
    set_up.venv = place / ".venv"
    assert set_up.run() == MADE
    assert set_up.shell(". .venv/bin/activate").startswith("reproduce: PATH cannot hold a folder")


@pytest.mark.slow
@pytest.mark.parametrize("installer", INSTALLERS)
def test_a_package_that_is_missing_is_installed_again_and_additions_stay(set_up, installer):
    if installer == "uv":
        set_up.with_uv()
    add = "from pipeline.cli.packages import add_packages as add; add('test'); add('test')"
    environment = set_up.environment | {"PYTHONPATH": str(set_up.tree / "src")}
    set_up.run()
    for _ in range(2):  # then it is there
        subprocess.run([set_up.venv / "bin/python", "-c", add], env=environment, check=True)
    mine = wheel(set_up.folder, "mine").split("==")[0]
    pip = "PIP_NO_INDEX=1 .venv/bin/python -m pip install -q --find-links .. mine"
    assert mine == "mine" and set_up.shell(pip) == ""
    assert set_up.run() == (0, "handed over\n")
    for names in (["extra", "needed", "pseudorigid.pth"], ["needed-1.0.dist-info"]):
        for name in names:
            (set_up.site / name).rename(set_up.folder / name)
        line = f"reproduce: .venv lacks {names[0]}: installing its packages again\n"
        assert set_up.run() == (0, f"handed over\n{line}")
    assert set_up.run() == (0, "handed over\n")
    for package in ("needed", "extra", "mine"):
        assert set_up.shell(f".venv/bin/{package}-where") == f"{set_up.venv}\n"


@pytest.mark.parametrize("how", ["missing", "cut"])
def test_a_run_that_fails_in_a_damaged_package_says_so_and_the_next_one_mends_it(set_up, how):
    set_up.with_uv()
    set_up.run()
    shutil.copy(ROOT / "src/pipeline/__main__.py", set_up.tree / "src/pipeline")
    main = "def main(words):\n    import needed.__init__\n    return needed.__init__.main()\n"
    (set_up.tree / "src/pipeline/cli/main.py").write_text(main)
    assert set_up.run() == (0, f"{set_up.venv}\n")
    file = set_up.site / "needed" / "__init__.py"
    file.write_text("import") if how == "cut" else file.unlink()
    damage = "needed/__init__.py"
    line = f"reproduce: .venv is damaged: {damage}: run ./reproduce again to mend it\n"
    assert set_up.run() == (1, line)
    line = f"reproduce: .venv lacks {damage}: installing its packages again\n"
    assert set_up.run() == (0, f"{set_up.venv}\n{line}")
    assert set_up.run() == (0, f"{set_up.venv}\n")


@pytest.mark.slow
@pytest.mark.parametrize("installer", INSTALLERS)
def test_a_bad_folder_of_wheels_is_reported(set_up, installer):
    if installer == "uv":
        set_up.with_uv()
    assert set_up.run("--offline", "nowhere") == (
        1,
        f"reproduce: {set_up.folder}/nowhere: there is no folder with wheels\n",
    )
    for words in (["--offline"], ["--offline", ""], ["--offline="]):
        assert set_up.run(*words)[0] == 2
    (needed,) = set_up.wheels.glob("needed*")
    whole = needed.read_bytes()
    for content in (whole[:-9] + b"corrupted", None):
        needed.write_bytes(content) if content else needed.unlink()
        status, output = set_up.run()
        assert status == 1
        assert output.splitlines()[-1].startswith("reproduce: could not install the packages")
        assert not (set_up.venv / "stamp").exists()
    needed.write_bytes(whole)
    environment = {"PSEUDORIGID_WHEELS": ""}
    status, output = set_up.run(f"--offline={set_up.wheels.name}", "fig3", **environment)
    assert (status, output) == (0, f"handed over fig3\n{LINE}")
    # Also where nothing has to be installed.
    nowhere = f"reproduce: {set_up.folder}/nowhere: there is no folder with wheels\n"
    assert set_up.run("--offline", "nowhere", "fig3") == (1, nowhere)


@pytest.mark.parametrize("installer", INSTALLERS)
def test_settings_choose_where_packages_come_from_and_nothing_else(set_up, installer):
    if installer == "uv":
        set_up.with_uv()
    wheels = set_up.wheels.rename(set_up.folder / "wheels")
    elsewhere = set_up.folder / "elsewhere"
    text = f"[global]\nno-index = true\nfind-links = {wheels}\n"
    text += f"[install]\nuser = true\ntarget = {elsewhere}\nno-binary = :all:\n"
    (set_up.folder / "pip.conf").write_text(text)
    hostile = {
        "PSEUDORIGID_WHEELS": "",
        "PIP_CONFIG_FILE": str(set_up.folder / "pip.conf"),
        "PIP_USER": "1",
        "PIP_PREFIX": str(elsewhere),
        "PIP_REQUIRE_VIRTUALENV": "1",
        "UV_SYSTEM_PYTHON": "1",
        "UV_PYTHON": sys.executable,
        "UV_NO_BINARY": "1",
        "VIRTUAL_ENV": str(elsewhere),
        "CONDA_PREFIX": str(elsewhere),
        "PYTHONHOME": str(elsewhere),
    }
    assert set_up.run(**hostile) == MADE
    assert set_up.installer() == installer
    assert set_up.shell(".venv/bin/needed-where") == f"{set_up.venv}\n"
    assert not elsewhere.exists()
