"""Install the pinned packages of requirements/ into .venv, with uv or else with pip.

`reproduce` calls `set_up` before any package is there: only the standard library is used here.
"""

import fcntl
import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path

from ...records.sources import ROOT
from ..session import UsageError, interruptible, locked, print_error
from . import activation, indexes

VENV = ROOT / ".venv"
LOG = VENV / "install.log"  # made first: a .venv with it is ours
STAMP = VENV / "stamp"  # made last: a .venv without it is not complete
CONTENTS = VENV / "contents"  # what lies in site-packages; `reproduce` looks whether it is there
MADE = ROOT / ".venv.made"  # the inode of the .venv that was made here
LINK = "made-by-reproduce"
TEXT = "installing the locked packages into .venv (once)"


def add_packages(name: str) -> None:
    """Install requirements/NAME.txt on top of the lock if that is not done; UsageError if it fails.

    An environment that is not .venv is left as it is.
    """
    wanted = (ROOT / "requirements" / f"{name}.txt").read_bytes()
    stamp = VENV / f"{name}-stamp"  # goes with .venv when that is made anew
    if Path(sys.prefix).resolve() != VENV.resolve():
        return
    if stamp.is_file() and stamp.read_bytes() == wanted:
        return
    with locked(), interruptible():
        begun = stamp.is_file()  # by a run that was killed, or with other packages
        stamp.touch()
        _install([name], f"installing requirements/{name}.txt into .venv (once)", begun)
        stamp.write_bytes(wanted)


def told_damage() -> bool:
    """Whether a file of a locked package is missing or cut; if so, say it, and have it mended.

    The next ./reproduce misses the file and installs the packages again.
    """
    if Path(sys.prefix).resolve() != VENV.resolve() or not CONTENTS.is_file():
        return False
    for package in _installed(_names()):
        for file in package.files or ():
            place = _site() / file
            size = place.stat().st_size if place.is_file() else None
            if file.parts[0] != ".." and file.suffix != ".pyc" and size != (file.size or size):
                place.unlink(missing_ok=True)
                with CONTENTS.open("a") as contents:
                    contents.write(f"{file}\n")
                print_error(f".venv is damaged: {file}: run ./reproduce again to mend it")
                return True
    return False


def set_up(wanted: str, arguments: list[str]) -> None:
    """Make .venv, or mend it, and hand over to `python -m pipeline`.

    Parameters
    ----------
    wanted : str
        What .venv is to be made from and for: the text of its stamp.
    arguments : list of str
        Of ./reproduce.
    """
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, signal.default_int_handler)
    try:
        with _only_one(arguments):
            whole = CONTENTS.is_file() and STAMP.is_file() and STAMP.read_text() == wanted
            if whole and _starts():
                _mend()
            else:
                _make("the Python of .venv does not start: making .venv again" if whole else TEXT)
            part = VENV / "stamp.part"
            part.write_text(wanted)
            part.rename(STAMP)
    except KeyboardInterrupt:
        print_error("interrupted: run it again to go on")
        sys.exit(130)
    except UsageError as error:
        print_error(str(error))
        sys.exit(1)
    except OSError as error:
        print_error(f"cannot make .venv: {error.strerror}: {error.filename}")
        sys.exit(1)
    python = str(VENV / "bin" / "python")
    os.execv(python, [python, "-P", "-m", "pipeline", *arguments])


@contextmanager
def _only_one(arguments):
    """Hold the lock of this folder; start over if another process had it.

    The installers inherit the lock: one that a killed set-up left behind is waited for.
    """
    try:
        lock = open(ROOT / ".lock", "a")  # noqa: SIM115  (closed below)
    except OSError:
        raise UsageError(f"cannot write into {ROOT}, where .venv is to be made") from None
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print_error("waiting for another ./reproduce in this folder to end")
            fcntl.flock(lock, fcntl.LOCK_EX)
            lock.close()
            os.execv(ROOT / "reproduce", [str(ROOT / "reproduce"), *arguments])
        os.set_inheritable(lock.fileno(), True)
        yield


def _starts():
    """Whether the interpreter of .venv starts."""
    try:
        return _run([VENV / "bin" / "python", "-I", "-S", "-c", ""])
    except OSError:
        return False


def _make(text):
    """Make .venv from nothing."""
    _remove()
    VENV.mkdir()
    MADE.write_text(f"{VENV.stat().st_ino}\n")
    LOG.touch()
    with _linked() as root:
        _check(_run([sys.executable, "-I", "-m", "venv", "--without-pip", f"{root}/.venv"]))
        activation.adopt(VENV, f"{root}/.venv")
    _install(["build", "lock"], text)


def _mend():
    """Install the packages again in a .venv that lacks some; what a user added stays."""
    STAMP.unlink()
    missing = [name for name in CONTENTS.read_text().splitlines() if not (_site() / name).exists()]
    if missing:
        _install(_names(), f".venv lacks {missing[0]}: installing its packages again", again=True)


def _remove():
    """Remove what is left of a .venv; UsageError where it is somebody else's."""
    removing = VENV.with_name(".venv.removing")
    shutil.rmtree(removing, ignore_errors=True)  # of a killed run
    if not os.path.lexists(VENV):
        return
    if not _ours():
        raise UsageError(f"{VENV} was not made by ./reproduce: please move it away")
    try:
        # Under another name first: half of it is never taken for somebody else's.
        VENV.rename(removing)
        shutil.rmtree(removing)
    except OSError:
        raise UsageError(f"cannot remove {VENV}, which is out of date") from None


def _ours():
    """Whether .venv was made here: its log is in it, or it is that folder still, or it is empty."""
    if VENV.is_symlink() or not VENV.is_dir():
        return False
    if LOG.is_file() or not any(VENV.iterdir()):
        return True
    made = MADE.read_text() if MADE.is_file() else ""
    about = VENV / "pyvenv.cfg"
    return (
        made.strip() == str(VENV.stat().st_ino)
        and (not about.exists() or f"/{LINK}/.venv" in about.read_text())
        and not (VENV / "conda-meta").exists()
    )


@contextmanager
def _linked():
    """A path of this folder without letters that installers cannot take, such as $ or a newline."""
    usual = tempfile.gettempdir()
    place = usual if re.fullmatch(r"[\w/.+-]{1,60}", usual, re.ASCII) else "/tmp"
    try:
        folder = tempfile.mkdtemp(dir=place)
    except OSError:
        raise UsageError(f"cannot make a temporary folder in {place}") from None
    try:
        (Path(folder) / LINK).symlink_to(ROOT)
        if wheels := os.environ.get("PSEUDORIGID_WHEELS"):
            (Path(folder) / "wheels").symlink_to(os.path.abspath(wheels))
        yield f"{folder}/{LINK}"
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _install(names, text, again=False):
    """Install requirements/NAME.txt of each name, by uv if possible; `again` also what is there."""
    with _linked() as root, _told(text, names) as tell:
        python = f"{root}/.venv/bin/python"
        pip = _pip(python)
        settings = indexes.pip_settings(pip)
        source = []
        if os.environ.get("PSEUDORIGID_WHEELS"):
            source = ["--no-index", "--find-links", os.path.dirname(root) + "/wheels"]
        elif settings.get("no-index", "0").lower() in ("1", "true", "yes", "on"):
            source = ["--no-index"]
        how = ["--require-hashes", *source, "-r"]
        of_pip = [*pip, "install", "--no-compile", "--progress-bar=off", *how]
        pip_environment = indexes.pip_environment(settings)

        def by_pip(name, *more):
            command = [*of_pip, f"{root}/requirements/{name}.txt", *more]
            return _run(command, pip_environment, tell)

        uv = _uv() or (by_pip("uv", "--only-binary=:all:", "--retries=1") and _uv())
        environment = indexes.uv_environment(settings)
        mine = "UV_CACHE_DIR" not in environment
        if mine:  # beside the packages, which are then links to it, and removed after them
            environment["UV_CACHE_DIR"] = f"{root}/.venv/cache/uv"
        else:
            environment["UV_LINK_MODE"] = "copy"  # an edited package is not another one's
        for name in names:
            command = [uv, "pip", "install", f"--python={python}", "--no-build-isolation"]
            command += [*how, f"{root}/requirements/{name}.txt", *["--reinstall"] * again]
            if not (uv and _run(command, environment, tell) and _entries([name])):
                more = ["--no-build-isolation", *["--force-reinstall"] * again]
                _check(by_pip(name, *more))
        if mine:
            shutil.rmtree(VENV / "cache" / "uv", ignore_errors=True)
        activation.adopt(VENV, f"{root}/.venv")
        activation.place_scripts(VENV)
    # A relative path, so that the folder may move.
    (_site() / "pseudorigid.pth").write_text("../../../../src\n")
    listed = CONTENTS.read_text().splitlines() if CONTENTS.exists() else ["pseudorigid.pth"]
    entries = _entries(name for name in names if name != "build") | {
        name for name in listed if (_site() / name).exists()
    }
    CONTENTS.write_text("".join(f"{name}\n" for name in sorted(entries)))


def _pip(python):
    """A command that runs pip for .venv: its own, or that of the present interpreter, or new."""
    if not (_site() / "pip").is_dir():
        if importlib.util.find_spec("pip") and _version("pip") >= (22, 3):
            return [sys.executable, "-I", "-m", "pip", f"--python={python}"]
        _check(_run([python, "-I", "-m", "ensurepip", "--default-pip"]))
    return [python, "-I", "-m", "pip"]


def _version(package):
    return tuple(int(part) for part in re.findall(r"\d+", metadata.version(package))[:2])


def _uv():
    """The uv of the pinned version, in .venv or on PATH; None where there is none."""
    (pinned,) = re.findall(r"^uv==(\S+)", (ROOT / "requirements" / "uv.txt").read_text(), re.M)
    for found in (VENV / "bin" / "uv", shutil.which("uv")):
        try:
            said = subprocess.check_output([found, "--version"], stderr=subprocess.DEVNULL)
        except (OSError, TypeError, subprocess.CalledProcessError):
            continue
        if said.decode().split()[1:2] == [pinned]:
            return str(found)
    return None


def _names():
    """The names of the requirements that .venv holds."""
    return ["lock", *(file.name.removesuffix("-stamp") for file in VENV.glob("*-stamp"))]


def _installed(names):
    """The packages of requirements/NAME.txt in site-packages."""
    pinned = {name.lower() for each in names for name in _pins(each)}
    for package in metadata.distributions(path=[str(_site())]):
        if re.sub(r"[-_.]+", "-", package.name).lower() in pinned:
            yield package


def _entries(names):
    """What the packages of requirements/NAME.txt have put into site-packages."""
    return {
        file.parts[0]
        for package in _installed(names)
        for file in package.files or ()
        if file.parts[0] not in ("..", "__pycache__")
    }


def _pins(name):
    text = (ROOT / "requirements" / f"{name}.txt").read_text()
    return re.findall(r"^([\w-]+)==(?!.*win32)", text, re.M)


def _site():
    (site,) = VENV.glob("lib/python3*/site-packages")
    return site


@contextmanager
def _told(text, names):
    """Tell in one line what is done; yields what counts the packages on a terminal."""
    total = sum(len(_pins(name)) for name in names)
    live = sys.stderr.isatty()
    if not live:
        print_error(text)

    def tell():
        unpacked = len(list(VENV.glob("cache/uv/archive-v0/*")))  # by uv
        done = unpacked or LOG.read_bytes().count(b"\nCollecting ")  # by pip
        if live:
            line = f"\rreproduce: {text}: {min(done, total)} of {total}"
            print(line, end="", file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        if live:
            print(file=sys.stderr)


def _run(command, environment=None, tell=lambda: None):
    """Run a command with its output in the log; whether it succeeded."""
    with LOG.open("ab") as log:
        child = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            env=environment or indexes.neutral_environment(),
            cwd=VENV,
            close_fds=False,  # the lock
        )
        try:
            while child.poll() is None:
                tell()
                time.sleep(0.05)
        finally:
            if child.poll() is None:
                child.terminate()
                child.wait()
    return child.returncode == 0


def _check(succeeded):
    """Refuse to go on after a command that failed."""
    if not succeeded:
        lines = LOG.read_text(errors="replace").splitlines()[-15:]
        print(*(line[:300] for line in lines), sep="\n", file=sys.stderr)
        raise UsageError(
            "could not install the packages (above: the end of .venv/install.log); "
            "run it again to retry"
        )
