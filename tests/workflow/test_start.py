"""Refusals before anything starts, and the installation of .venv."""

import os
import re
import shutil
import signal
import subprocess
import sys
import zipfile
from hashlib import sha256
from pathlib import Path

import pytest

from helpers.project import ROOT, path_of_bare_python, run, wait_for
from helpers.slowly import slowly
from pipeline.cli import packages


def test_a_bad_config_is_a_line_a_mistake_and_starts_nothing(tree):
    tree.edit("fig5", energy=0.9)
    tree.edit("fig7", impact=3)
    text = [line.strip() for line in tree.config.read_text().splitlines()]
    energy, impact = (text.index(line) + 1 for line in ("energy: 0.9", "impact: 3"))
    lines = (
        f"config.yaml: line {energy}: scenes.fig5.energy: 0.9 is not allowed: expected a number "
        "below k/2 - g = 0.06, where the ball could flatten to nothing\n"
        f"config.yaml: line {impact}: scenes.fig7.impact: unknown key: did you mean impacts?\n"
    )
    result = tree.run()
    assert (result.returncode, result.stdout) == (1, lines) and not (tree.path / "results").exists()


# Words, config.yaml (None: no file), exit status, and how the line begins.
EARLY = [
    ("verify fig3", "x", 2, "reproduce verify: no argument fig3: usage: ./reproduce verify [-h]"),
    ("fig2 --cores x", "x", 2, "reproduce: argument -c/--cores: 'x' is not allowed"),
    ("fig2", None, 1, "reproduce: config.yaml: cannot be read: No such file or directory"),
    ("fig2", "ball:\n\tk: 0.2\n", 1, "reproduce: config.yaml: line 2: begins with a tab"),
    ("fig2", "# nothing\n", 1, "reproduce: config.yaml: is empty"),
    ("fig2", "\udcff", 1, "reproduce: config.yaml: is not UTF-8 text: byte 0"),
    ("--version", None, 0, "pseudorigid "),
]


def test_a_mistake_that_needs_no_package_is_reported_before_packages_are_installed(tree, tmp_path):
    path = path_of_bare_python(tmp_path / "bin")
    for words, text, status, line in EARLY:
        tree.config.unlink(missing_ok=True)
        if text is not None:
            tree.config.write_bytes(text.encode(errors="surrogateescape"))
        result = run(tree.path / "reproduce", *words.split(), env={"PATH": path}, cwd="/")
        assert (result.returncode, result.stderr.count("\n")) == (status, int(status > 0))
        assert (result.stdout + result.stderr).startswith(line)
    assert not (tree.path / ".venv").exists()


@pytest.mark.slow
def test_commands_that_only_read_need_no_permission_to_write(finished, tmp_path):
    """In a folder of another user."""
    tree = finished.copy(tmp_path / "tree")
    tree.warm()
    site = "import os\nmay, opens = os.access, os.open\n"
    site += "os.access = lambda path, mode: mode != os.W_OK and may(path, mode)\n"
    site += "def refuse(path, flags, *how, **more):\n"
    site += f"    if flags & os.O_RDWR and str(path).startswith({str(tree.path)!r}):\n"
    site += "        raise PermissionError(13, 'Permission denied', str(path))\n"
    site += "    return opens(path, flags, *how, **more)\n"
    site += "os.open = refuse\n"
    (tree.path / "src/sitecustomize.py").write_text(site)
    for words in ("list", "verify", "-n"):
        result = tree.run(*words.split())
        assert "annot" not in result.stdout and "Traceback" not in result.stdout, result.stdout
        assert result.returncode == int(words == "verify")  # nothing is committed here
    assert "cannot write in" in tree.run("fig3").stdout


@pytest.mark.slow
def test_the_code_of_one_tree_does_not_run_the_workflow_of_another(tree):
    """On a cluster, a job could import the packages of another checkout."""
    result = tree.python("-m", "snakemake", "--cores", "1", PYTHONPATH=str(ROOT / "src"))
    line = f"reproduce: this is {tree.path}, but the code of {ROOT} runs: use ./reproduce here\n"
    assert (result.returncode, result.stderr.split("\n", 1)[1]) == (1, line)
    assert not (tree.path / "results").exists()


# What a Python says of itself (None: there is none), and the line about it.
UNSUITABLE = [
    (None, "no python3 found: please install Python 3.11 to 3.14"),
    ("sys.version_info = (3, 9, 2)", "needs Python 3.11 to 3.14, but python3 is 3.9.2"),
    ("sys.version_info = (3, 15, 0)", "needs Python 3.11 to 3.14, but python3 is 3.15.0"),
    ("sys.modules['ensurepip'] = None", "python3 lacks the venv module: please install it (Debian, "
     "Ubuntu: apt install python3-venv)"),
    ("sys.version_info = (3, 14, 0)", "python3 is 3.14.0, for which one package has to be compiled"
     ": please install a C compiler and the headers of Python (Debian, Ubuntu: apt install gcc "
     "python3-dev), or Python 3.11 to 3.13"),
]  # fmt: skip


def test_an_unsuitable_python_is_one_line(tree, tmp_path):
    (path := tmp_path / "bin").mkdir()
    for tool in ("readlink", "cat", "cksum", "uname", "cut", "tail", "mkdir", "rm", "sh"):
        (path / tool).symlink_to(shutil.which(tool))
    version = "import platform\nplatform.python_version = lambda: '.'.join(map(str, version))\n"
    version = f"version = sys.version_info[:3]\n{version}exec(sys.argv.pop())"
    for pretend, line in UNSUITABLE:
        if pretend:
            program, python = tmp_path / "program.py", path / "python3"
            program.write_text(f"import sys\n{pretend}\n{version}")
            python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{program}" "$2"\n')
            python.chmod(0o755)
        result = run(tree.path / "reproduce", env={"PATH": str(path)}, cwd="/")
        assert (result.returncode, result.stdout) == (1, "")
        assert result.stderr == f"reproduce: {line}\n"
    assert not (tree.path / ".venv").exists()


LINE = "reproduce: installing the locked packages into .venv (once)\n"
MADE, READY = (0, f"handed over\n{LINE}"), (0, "handed over\n")
UV = ROOT / ".venv" / "bin" / "uv"  # a package of the tests; a run keeps none
# A uv of the right version whose installations succeed, slowly if the file SLOW is there.
SLOW_UV = """#!/bin/sh
[ "$1" != --version ] || { echo uv %s; exit; }
[ ! -e "$SLOW" ] || { echo $$ >"$SLOW.pid"; exec sleep 60; }
exit 1
"""


def wheel(folder, name, script=""):
    """Write a wheel of a module, `name`, with a script that prints where it runs."""
    info, script = f"{name}-1.0.dist-info", script or f"{name}-where"
    files = {
        f"{name}/__init__.py": "import sys\ndef main(): print(sys.prefix, *sys.argv[1:])\n",
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{info}/entry_points.txt": f"[console_scripts]\n{script} = {name}:main\n",
    }
    record = f"{info}/RECORD"
    files[record] = "".join(f"{path},,\n" for path in (*files, record))
    file = folder / f"{name}-1.0-py3-none-any.whl"
    with zipfile.ZipFile(file, "w") as archive:
        for path, text in files.items():
            archive.writestr(path, text)
    return f"{name}==1.0 --hash=sha256:{sha256(file.read_bytes()).hexdigest()}\n"


def without_waits(output):
    """Leave out the lines of an installation that takes seconds on a busy machine."""
    return re.sub(r"reproduce: installing: packages so far: \d+\n", "", output)


class SetUp:
    """A tree that installs three small packages and prints a line instead of making figures."""

    def __init__(self, tree, folder):
        self.tree, self.venv, self.folder = tree.path, tree.path / ".venv", folder
        self.wheels = folder / "a folder of mine"
        self.wheels.mkdir()
        for name, package in (("build", "tools"), ("lock", "needed"), ("test", "extra")):
            file = self.tree / "requirements" / f"{name}.txt"
            file.write_text(wheel(self.wheels, package))
        printed = "*sys.argv[1:], *sys.warnoptions, *['no caches'] * sys.dont_write_bytecode"
        main = f"import sys\nprint('handed over', {printed})\n"
        (self.tree / "src" / "pipeline" / "__main__.py").write_text(main)
        path = path_of_bare_python(folder / "bin")
        (folder / "tmp").mkdir()
        self.slow = folder / "slow"
        self.environment = {
            "HOME": str(folder),
            "PATH": path,
            "PSEUDORIGID_WHEELS": str(self.wheels),
            "TMPDIR": str(folder / "tmp"),
            "SLOW": str(self.slow),
            "PYTHONWARNINGS": "error",  # neither may reach python -m pipeline
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    def run(self, *arguments, **environment):
        environment = self.environment | environment
        command = self.venv.parent / "reproduce"
        result = run(command, *arguments, env=environment, cwd=self.folder)
        return result.returncode, result.stdout + without_waits(result.stderr)

    def start(self):
        return subprocess.Popen(
            [self.tree / "reproduce"],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            # A job in the background of a shell would ignore it.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
        )

    def with_its_packages(self):
        """Let the base Python have its packages, of which pip saves the installation of one."""
        python = self.folder / "bin/python3"
        python.write_text(python.read_text().replace(" -S", ""))

    def shell(self, command, shell="sh"):
        """Return what a command prints in a shell, in the folder of the tree."""
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder)}
        result = run(shell, "-c", command, env=environment, cwd=self.venv.parent)
        return result.stdout + result.stderr

    @property
    def site(self):
        (site,) = self.venv.glob("lib/python3*/site-packages")
        return site


@pytest.fixture
def set_up(tree, tmp_path):
    return SetUp(tree, tmp_path)


@pytest.fixture
def with_uv(set_up):
    """A SetUp that finds the uv of this .venv on PATH."""
    if not UV.exists():
        pytest.skip("uv has no wheel for this machine")
    (set_up.folder / "bin" / "uv").symlink_to(UV)
    return set_up


@pytest.fixture(params=["uv", *slowly("pip")])
def with_either(request):
    """A SetUp with uv, or with pip alone, that of the base Python if it has one."""
    set_up = request.getfixturevalue("with_uv" if request.param == "uv" else "set_up")
    if request.param == "pip":
        set_up.with_its_packages()
    set_up.installer = request.param
    return set_up


def require_installed(set_up, installer):
    assert (set_up.site / "needed-1.0.dist-info/INSTALLER").read_text().strip() == installer


@pytest.mark.slow
def test_a_venv_that_is_incomplete_or_does_not_start_is_made_anew(with_uv):
    (with_uv.venv / "cache").mkdir(parents=True)  # of a plain snakemake
    assert with_uv.run() == MADE
    (with_uv.venv / "stamp").unlink()
    assert with_uv.run() == MADE
    python = with_uv.venv / "bin" / "python"
    for target in ("nowhere", "/bin/false"):
        python.unlink()
        python.symlink_to(target)
        assert with_uv.run() == MADE, target
    assert with_uv.run() == READY
    (with_uv.tree / "requirements" / "lock.txt").write_text(wheel(with_uv.wheels, "other"))
    assert with_uv.run() == MADE and not (with_uv.site / "needed").exists()


@pytest.mark.slow
def test_a_venv_of_somebody_else_stays(with_uv):
    venv = with_uv.venv
    line = f"reproduce: {venv} was not made by ./reproduce: please move it away\n"
    (venv / "bin").mkdir(parents=True)
    assert with_uv.run() == (1, line)
    kept = venv.rename(with_uv.folder / "kept")
    venv.symlink_to(kept)
    assert with_uv.run() == (1, line)
    venv.unlink()
    venv.write_text("mine")
    assert with_uv.run() == (1, line) and venv.read_text() == "mine" and (kept / "bin").is_dir()


def start_slowly(set_up):
    """Start ./reproduce with an installer that sleeps; return it and the process id."""
    (version,) = re.findall(r"^uv==(\S+)", (ROOT / "requirements/uv.txt").read_text(), re.MULTILINE)
    (set_up.folder / "bin" / "uv").write_text(SLOW_UV % version)
    (set_up.folder / "bin" / "uv").chmod(0o755)
    set_up.slow.touch()
    set_up.with_its_packages()
    process = set_up.start()
    pid = set_up.folder / "slow.pid"
    wait_for(lambda: pid.exists() and pid.read_text().strip())
    return process, int(pid.read_text())


def test_a_signal_to_the_set_up_ends_its_installer(set_up):
    process, installer = start_slowly(set_up)
    process.send_signal(signal.SIGINT)
    _, output = process.communicate(timeout=30)
    assert process.returncode == 130
    assert without_waits(output) == f"{LINE}reproduce: interrupted: run it again to go on\n"
    assert not Path(f"/proc/{installer}").exists()


@pytest.mark.slow
def test_the_installer_of_a_killed_set_up_is_waited_for(set_up):
    process, installer = start_slowly(set_up)
    process.kill()
    process.communicate()
    set_up.slow.unlink()
    next_one = set_up.start()
    with pytest.raises(subprocess.TimeoutExpired):
        next_one.communicate(timeout=2)
    os.kill(installer, signal.SIGKILL)
    out, output = next_one.communicate(timeout=60)
    assert out == "handed over\n"
    require_installed(set_up, "pip")  # since this uv fails
    assert without_waits(output) == LINE


@pytest.mark.slow
def test_the_venv_works_in_a_folder_with_a_space_and_is_made_anew_where_it_is_moved(with_either):
    set_up = with_either
    for name in ("the first, é", "moved"):
        place = set_up.venv.parent.rename(set_up.folder / name)
        set_up.venv = place / ".venv"
        assert set_up.run(LC_ALL="C") == MADE
        require_installed(set_up, set_up.installer)
        assert set_up.shell(".venv/bin/needed-where 'a b'") == f"{set_up.venv} a b\n"
        for shell in ("sh", "bash", "zsh"):
            if shutil.which(shell, path="/usr/bin:/bin"):
                activated = set_up.shell(". ./.venv/bin/activate; needed-where", shell)
                assert activated == f"{set_up.venv}\n"
        assert set_up.run() == READY
    place = set_up.venv.parent.rename(set_up.folder / "größer, 日")
    for locale in ("C", "xx_YY.UTF-8", "C.UTF-8"):  # the second is not installed
        command = ".venv/bin/python -c 'import pipeline; print(*pipeline.__path__)'"
        environment = {"PATH": "/usr/bin:/bin", "LC_ALL": locale}
        result = run("sh", "-c", command, env=environment, cwd=place, encoding="utf-8")
        assert (result.stdout, result.stderr) == (f"{place}/src/pipeline\n", "")


def test_a_folder_that_installers_cannot_take_is_refused_in_one_line(set_up):
    for name in ('"a"', "it's", "a$b", "a`b", "a\\b", "a:b", "a;b", "a\nb"):
        place = set_up.venv.parent.rename(set_up.folder / name)
        set_up.venv = place / ".venv"
        status, output = set_up.run()
        line = f"reproduce: {str(place)!r}: installers cannot take "
        assert status == 1 and output.startswith(line)
        assert output.count("\n") == 1 and not set_up.venv.exists()


@pytest.mark.slow
def test_added_packages_stay(set_up):
    add = "from pipeline.cli.packages import add_packages as add; add('test'); add('test')"
    environment = set_up.environment | {"PYTHONPATH": str(set_up.tree / "src")}
    set_up.run()
    for _ in range(2):  # then it is there
        subprocess.run([set_up.venv / "bin/python", "-c", add], env=environment, check=True)
    wheel(set_up.folder, "mine")
    pip = "PIP_NO_INDEX=1 .venv/bin/python -m pip install -q --find-links .. mine"
    assert set_up.shell(pip) == "" and set_up.run() == READY
    for package in ("needed", "extra", "mine"):
        assert set_up.shell(f".venv/bin/{package}-where") == f"{set_up.venv}\n"


@pytest.mark.slow
def test_no_installer_stays_but_pip(set_up):
    """uv, which a run downloads, is larger than what it installs here."""
    (set_up.tree / "requirements" / "uv.txt").write_text(wheel(set_up.wheels, "uv", "uv"))
    assert set_up.run() == MADE
    assert "Successfully installed uv" in (set_up.venv / "install.log").read_text()
    assert not list(set_up.venv.rglob("uv*"))


def test_what_outdated_results_import_is_installed_first_and_nothing_else(tmp_path, monkeypatch):
    installed = []
    monkeypatch.setattr(packages, "ROOT", tmp_path)
    monkeypatch.setattr(packages, "VENV", tmp_path / ".venv")
    monkeypatch.setattr(packages, "_install", lambda name, again: installed.append((name, again)))
    monkeypatch.setattr(packages.sys, "prefix", str(tmp_path / ".venv"))
    for folder in (".venv", "requirements"):
        (tmp_path / folder).mkdir()
    (tmp_path / "requirements" / "algebra.txt").write_text("sympy==1.0\n")
    (tmp_path / "plain.py").write_text("import numpy\n")
    (tmp_path / "inner.py").write_text("import numpy\ndef f():\n    from flint import arb\n")
    packages.add_imported(["plain.py"])
    assert installed == []
    packages.add_imported(["plain.py", "inner.py"])
    packages.add_imported(["inner.py"])
    assert installed == [("algebra", False)]
    (tmp_path / "requirements" / "algebra.txt").write_text("sympy==1.1\n")
    packages.add_imported(["inner.py"])
    assert installed[1:] == [("algebra", True)]
    monkeypatch.setattr(packages.sys, "prefix", "/elsewhere")
    (tmp_path / ".venv" / "algebra-stamp").unlink()
    packages.add_imported(["inner.py"])
    assert len(installed) == 2


@pytest.mark.slow
def test_a_bad_folder_of_wheels_is_reported(with_either):
    set_up = with_either
    nowhere = (2, "reproduce: --offline needs a folder with wheels, which 'nowhere' is not\n")
    assert set_up.run("--offline", "nowhere") == nowhere and set_up.run("--offline")[0] == 2
    (needed,) = set_up.wheels.glob("needed*")
    whole = needed.read_bytes()
    needed.write_bytes(whole[:-9] + b"corrupted")
    for words in ("needed==1.0 is damaged: its hash is not in requirements/ ", "ERROR: No match"):
        status, output = set_up.run()
        assert status == 1
        line = f"reproduce: could not install the packages: {words}"
        assert output.splitlines()[-1].startswith(line) and not (set_up.venv / "stamp").exists()
        needed.unlink(missing_ok=True)
    needed.write_bytes(whole)
    output = set_up.run(f"--offline={set_up.wheels.name}", "fig3", PSEUDORIGID_WHEELS="")
    assert output == (0, f"handed over fig3\n{LINE}")


@pytest.mark.slow
def test_settings_choose_where_packages_come_from_and_nothing_else(with_either):
    set_up = with_either
    wheels = set_up.wheels.rename(set_up.folder / "wheels")
    elsewhere = set_up.folder / "elsewhere"
    text = f"[global]\nno-index = true\nfind-links = {wheels}\n"
    text += f"[install]\nuser = true\ntarget = {elsewhere}\nno-binary = :all:\n"
    (set_up.folder / "pip.conf").write_text(text)
    folders = ("PIP_PREFIX", "VIRTUAL_ENV", "CONDA_PREFIX", "PYTHONHOME")
    switches = ("PIP_USER", "PIP_REQUIRE_VIRTUALENV", "UV_SYSTEM_PYTHON", "UV_NO_BINARY")
    hostile = dict.fromkeys(folders, str(elsewhere)) | dict.fromkeys(switches, "1")
    hostile |= {"PSEUDORIGID_WHEELS": "", "UV_PYTHON": sys.executable}
    assert set_up.run(**hostile, PIP_CONFIG_FILE=str(set_up.folder / "pip.conf")) == MADE
    require_installed(set_up, set_up.installer)
    assert set_up.shell(".venv/bin/needed-where") == f"{set_up.venv}\n" and not elsewhere.exists()
