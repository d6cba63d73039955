"""Install the pinned packages of requirements/ into .venv, with uv or else with pip.

`reproduce` calls `set_up` before any package is installed: only the standard library is used here.
"""

import importlib.util
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import chdir, contextmanager
from importlib import metadata
from pathlib import Path

from ...records.files import FileError, write_whole
from ...records.sources import ROOT
from ..session import UsageError, interruptible, locked, print_error
from . import indexes, wheels

VENV = ROOT / ".venv"
LOG = VENV / "install.log"  # written first: a .venv with it was made by ./reproduce
STAMP = VENV / "stamp"  # written last: a .venv without it is incomplete
CONTENTS = VENV / "contents"  # what was installed in site-packages; `reproduce` checks it


def add_packages(name: str) -> None:
    """Install requirements/NAME.txt on top of the lock, once; UsageError if that fails.

    An environment that is not .venv is left as it is.
    """
    requirements = (ROOT / "requirements" / f"{name}.txt").read_bytes()
    stamp = VENV / f"{name}-stamp"  # a new .venv has none
    if Path(sys.prefix).resolve() != VENV.resolve():
        return
    if stamp.is_file() and stamp.read_bytes() == requirements:
        return
    with locked(), interruptible():
        again = stamp.is_file()  # left by a killed run or for other packages
        stamp.touch()
        _install([name], f"installing requirements/{name}.txt into .venv (once)", again)
        stamp.write_bytes(requirements)


def report_damage() -> bool:
    """Report whether a file of a locked package is missing or cut; the next run installs anew."""
    if Path(sys.prefix).resolve() != VENV.resolve() or not STAMP.is_file():
        return False
    for file, path in _files(_requirement_names()):
        size = path.stat().st_size if path.is_file() else None
        if file.suffix != ".pyc" and size != (file.size or size):
            STAMP.unlink()
            print_error(f".venv is damaged: {file}: run ./reproduce again to mend it")
            return True
    return False


def set_up(stamp: str, arguments: list[str]) -> None:
    """Make .venv, then replace this process by `python -m pipeline` with the arguments.

    `stamp` is the text of STAMP: what .venv is made from and for.
    """
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup ignores SIGHUP
            signal.signal(number, signal.default_int_handler)
    try:
        with chdir(ROOT), locked():
            if not _is_complete(stamp):  # as another process may have made it meanwhile
                _make()
                write_whole(STAMP, stamp)
    except KeyboardInterrupt:
        print_error("interrupted: run it again to go on")
        sys.exit(130)
    except (UsageError, FileError, OSError) as error:
        print_error(str(error))
        sys.exit(1)
    if os.environ.get("PSEUDORIGID_WHEELS") == str(ROOT / wheels.FOLDER):
        del os.environ["PSEUDORIGID_WHEELS"]  # it has not the packages that other commands add
    python = str(VENV / "bin" / "python")
    os.execv(python, [python, "-P", "-m", "pipeline", *arguments])


def _is_complete(stamp: str) -> bool:
    """Return whether .venv has its packages and its Python starts."""
    try:
        if STAMP.read_text() != stamp or not _run([VENV / "bin" / "python", "-I", "-S", "-c", ""]):
            return False
        return all((_site_packages() / name).exists() for name in CONTENTS.read_text().splitlines())
    except (OSError, ValueError):
        return False


def _make() -> None:
    """Make .venv from nothing."""
    _remove()
    VENV.mkdir()
    LOG.touch()
    with _plain_path() as root:
        _make_environment(f"{root}/.venv")
    _install(["build", "lock"], "installing the locked packages into .venv (once)")


def _make_environment(path: str | Path) -> None:
    """Make a virtual environment, or only its scripts if it is there."""
    _check(_run([sys.executable, "-I", "-m", "venv", "--without-pip", path]))


def _remove() -> None:
    """Remove an incomplete .venv; UsageError if ./reproduce did not make it."""
    removing = VENV.with_name(".venv.removing")
    shutil.rmtree(removing, ignore_errors=True)  # left by a killed run
    if not os.path.lexists(VENV):
        return
    empty = VENV.is_dir() and not any(VENV.iterdir())
    if VENV.is_symlink() or not (empty or LOG.is_file()):
        raise UsageError(f"{VENV} was not made by ./reproduce: please move it away")
    try:
        # The new name first: a half-removed .venv could be taken for a user's.
        VENV.rename(removing)
        shutil.rmtree(removing)
    except OSError:
        raise UsageError(f"cannot remove {VENV}, which is out of date") from None


@contextmanager
def _plain_path() -> Iterator[str]:
    """Yield a link to this folder whose path has no letters that break installers, such as $."""
    usual = tempfile.gettempdir()
    parent = usual if re.fullmatch(r"[\w/.+-]{1,60}", usual, re.ASCII) else "/tmp"
    try:
        folder = tempfile.mkdtemp(dir=parent)
    except OSError:
        raise UsageError(f"cannot make a temporary folder in {parent}") from None
    try:
        (Path(folder) / "root").symlink_to(ROOT)
        if wheels := os.environ.get("PSEUDORIGID_WHEELS"):
            (Path(folder) / "wheels").symlink_to(os.path.abspath(wheels))
        yield f"{folder}/root"
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _install(names: list[str], message: str, again: bool = False) -> None:
    """Install requirements/NAME.txt of each name, by uv if possible.

    With `again`, packages that are present are installed too.
    """
    with _plain_path() as root, _progress(message, names) as tick:
        pip = _pip()
        settings = indexes.pip_settings(pip)
        source = []
        if folder := os.environ.get("PSEUDORIGID_WHEELS"):
            wheels.refuse_damaged(Path(folder))
            source = ["--no-index", "--find-links", os.path.dirname(root) + "/wheels"]
        elif settings.get("no-index", "0").lower() in ("1", "true", "yes", "on"):
            source = ["--no-index"]

        def options(name: str) -> list[str]:
            return ["--require-hashes", *source, "-r", f"{root}/requirements/{name}.txt"]

        def by_pip(name: str, *more: str) -> bool:
            command = [*pip, "install", "--no-compile", "--progress-bar=off", *more]
            return _run([*command, *options(name)], indexes.pip_environment(settings), tick)

        uv = _uv() or (by_pip("uv", "--only-binary=:all:", "--retries=1") and _uv())
        environment = indexes.uv_environment(settings)
        own_cache = "UV_CACHE_DIR" not in environment
        if own_cache:  # beside the packages, which become hard links, and removed afterwards
            environment["UV_CACHE_DIR"] = f"{root}/.venv/cache/uv"
        else:
            environment["UV_LINK_MODE"] = "copy"  # an edit of a package must not reach the cache
        if uv and "relocatable" not in (VENV / "pyvenv.cfg").read_text():
            command = [uv, "venv", "--relocatable", "--allow-existing"]
            command += [f"--python={root}/.venv/bin/python", f"{root}/.venv"]
            uv = uv if _run(command, environment) else None
            if uv:
                _write_path()
        if not uv:
            _make_environment(VENV)
        for name in names:
            installed = False
            if uv:
                command = [uv, "pip", "install", f"--python={root}/.venv/bin/python"]
                command += ["--no-build-isolation", *["--reinstall"] * again]
                installed = _run([*command, *options(name)], environment, tick)
            if not (installed and any(_files([name]))):
                _check(by_pip(name, "--no-build-isolation", *["--force-reinstall"] * again))
        if own_cache:
            shutil.rmtree(VENV / "cache" / "uv", ignore_errors=True)
    # A relative path, so that the folder can be moved.
    (_site_packages() / "pseudorigid.pth").write_text("../../../../src\n")
    # Without pyvenv.cfg, the interpreter starts but finds no package.
    listed = ["pseudorigid.pth", "../../../pyvenv.cfg"]
    listed = CONTENTS.read_text().splitlines() if CONTENTS.exists() else listed
    entries = {name for name in listed if (_site_packages() / name).exists()}
    entries |= {file.parts[0] for file, _ in _files(name for name in names if name != "build")}
    CONTENTS.write_text("".join(f"{name}\n" for name in sorted(entries)))


def _write_path() -> None:
    """Write the path of .venv into the scripts for csh and sh, in which uv cannot find it."""
    path = shlex.quote(str(VENV))
    csh_path = path.replace("!", "\\!")
    bash = '    if [ -n "${BASH_VERSION:+x}" ] ; then\n        SCRIPT_PATH='
    for name, pattern, words in (
        ("activate.csh", "setenv VIRTUAL_ENV .*", f"setenv VIRTUAL_ENV {csh_path}"),
        ("activate", re.escape(bash), f"    SCRIPT_PATH={path}/bin/activate\n{bash}"),
    ):
        script, new = VENV / "bin" / name, words.replace("\\", r"\\")
        text = re.sub(f"^{pattern}", new, script.read_text(), flags=re.MULTILINE)
        script.write_bytes(os.fsencode(text))


def _pip() -> list[str]:
    """Return a command that runs pip for .venv: its own, this interpreter's, or a new one."""
    python = str(VENV / "bin" / "python")  # the scripts that pip writes have this path
    if not (_site_packages() / "pip").is_dir():
        if importlib.util.find_spec("pip"):
            return [sys.executable, "-I", "-m", "pip", f"--python={python}"]
        _check(_run([python, "-I", "-m", "ensurepip", "--default-pip"]))
    return [python, "-I", "-m", "pip"]


def _uv() -> str | None:
    """Return the path of a uv of the pinned version, in .venv or on PATH."""
    (pinned,) = re.findall(r"^uv==(\S+)", (ROOT / "requirements" / "uv.txt").read_text(), re.M)
    for path in (str(VENV / "bin" / "uv"), shutil.which("uv")):
        try:
            output = subprocess.check_output([path or "", "--version"], stderr=subprocess.DEVNULL)
        except (OSError, subprocess.CalledProcessError):
            continue
        if output.decode().split()[1:2] == [pinned]:
            return path
    return None


def _requirement_names() -> list[str]:
    """Names of the requirements that .venv holds."""
    return ["lock", *(file.name.removesuffix("-stamp") for file in VENV.glob("*-stamp"))]


def _files(names: Iterable[str]) -> Iterator[tuple[metadata.PackagePath, Path]]:
    """Yield the files in site-packages that belong to the packages of requirements/NAME.txt."""
    site = _site_packages()
    pinned = {package.lower() for name in names for package in _pins(name)}
    for package in metadata.distributions(path=[str(site)]):
        if re.sub(r"[-_.]+", "-", package.name).lower() in pinned:
            for file in package.files or ():
                if file.parts[0] not in ("..", "__pycache__"):
                    yield file, site / file


def _pins(name: str) -> list[str]:
    text = (ROOT / "requirements" / f"{name}.txt").read_text()
    return re.findall(r"^([\w-]+)==(?!.*win32)", text, re.M)


def _site_packages() -> Path:
    (path,) = VENV.glob("lib/python3*/site-packages")
    return path


@contextmanager
def _progress(message: str, names: list[str]) -> Iterator[Callable[[], None]]:
    """Print the message; on a terminal, the function yielded appends how many are installed."""
    total = sum(len(_pins(name)) for name in names)
    live = sys.stderr.isatty()
    if not live:
        print_error(message)

    def tick() -> None:
        unpacked = len(list(VENV.glob("cache/uv/archive-v0/*")))  # by uv
        done = unpacked or LOG.read_bytes().count(b"\nCollecting ")  # by pip
        if live:
            line = f"\rreproduce: {message}: {min(done, total)} of {total}"
            print(line, end="", file=sys.stderr, flush=True)

    try:
        yield tick
    finally:
        if live:
            print(file=sys.stderr)


def _run(
    command: Sequence[str | Path],
    environment: dict[str, str] | None = None,
    tick: Callable[[], None] = lambda: None,
) -> bool:
    """Run a command with its output in the log, and return whether it succeeded."""
    with (
        LOG.open("ab") as log,
        subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            env=environment or indexes.neutral_environment(),
            cwd=VENV,
            close_fds=False,  # the child inherits the lock
        ) as child,
    ):
        try:
            while child.poll() is None:
                tick()
                time.sleep(0.05)
        finally:
            child.terminate()
    return child.poll() == 0


def _check(succeeded: bool) -> None:
    """Raise UsageError after a command that failed, below the end of its log."""
    if not succeeded:
        lines = LOG.read_text(errors="replace").splitlines()[-15:]
        print(*(line[:300] for line in lines), sep="\n", file=sys.stderr)
        raise UsageError(
            "could not install the packages (above: the end of .venv/install.log); "
            "run it again to retry"
        )
