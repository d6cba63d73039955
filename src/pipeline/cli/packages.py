"""Install the pinned packages of requirements/ into .venv, with uv or else with pip.

`reproduce` calls `set_up` before any package is installed: only the standard library is used here.
"""

import ast
import importlib.util
import os
import re
import shutil
import signal
import ssl
import subprocess
import sys
from collections.abc import Iterable, Sequence
from contextlib import chdir, closing, nullcontext, suppress
from pathlib import Path
from typing import Any

from ..jobs.heartbeat import Heartbeat
from ..records.files import FileError, read_yaml, write_whole
from ..records.sources import ROOT, parsed
from .arguments import read
from .errors import UsageError, one_line, print_error
from .lock import locked
from .running import interruptible

# Modules that no figure of the paper imports -> the list in requirements/ of their packages.
_ON_DEMAND = {"flint": "algebra", "sympy": "algebra"}
VENV = ROOT / ".venv"
PYTHON = str(VENV / "bin" / "python")
LOG = VENV / "install.log"  # written first: a .venv with it was made by ./reproduce
STAMP = VENV / "stamp"  # written last: a .venv without it is incomplete
# The settings of pip that are kept, with their names for uv. Others could install elsewhere, or
# other packages.
_SETTINGS = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "cert": "SSL_CERT_FILE",
    "client-cert": "SSL_CLIENT_CERT",
    "proxy": "ALL_PROXY",
    **dict.fromkeys(("no-index", "timeout", "default-timeout", "retries", "keyring-provider"), ""),
}
_UV = (
    r"UV_(\w*INDEX|FIND_LINKS|KEYRING|INSECURE_HOST|SYSTEM_CERTS|NATIVE_TLS|HTTP|CACHE_DIR"
    r"|CONFIG_FILE|CREDENTIALS|CONCURRENT|OFFLINE|REQUEST)"
)


def add_packages(*names: str, held: bool = False) -> None:
    """Install requirements/NAME.txt of each name on top of the lock, once, or raise UsageError.

    An environment that is not .venv is left as it is. `held` says that this process has the lock.
    """
    if Path(sys.prefix).resolve() != VENV.resolve():
        return
    for name in names:
        requirements = (ROOT / "requirements" / f"{name}.txt").read_bytes()
        stamp = VENV / f"{name}-stamp"  # a new .venv has none
        if stamp.is_file() and stamp.read_bytes() == requirements:
            continue
        with nullcontext() if held else locked(), interruptible():
            again = stamp.is_file()  # left by a killed run or for other packages
            stamp.touch()
            print_error(f"installing requirements/{name}.txt into .venv (once)")
            _install(name, again=again)
            stamp.write_bytes(requirements)


def add_imported(sources: Iterable[str]) -> None:
    """Install what these files import and the lock lacks, in a process that has the lock."""
    imports = (parsed(file, (ROOT / file).read_bytes()).imports for file in sources)
    modules = {each[1].partition(".")[0] for of_file in imports for each in of_file}
    add_packages(*{_ON_DEMAND[name] for name in modules & _ON_DEMAND.keys()}, held=True)


def set_up(stamp: str, *arguments: str) -> None:
    """Make .venv, then replace this process by `python -m pipeline` with the arguments.

    `stamp` is the text of STAMP: what .venv is made from and for. Mistakes that need no package to
    be seen are reported first. Where nothing can be written, .venv is used as it is.
    """
    read([*arguments])
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup ignores SIGHUP
            signal.signal(number, signal.default_int_handler)
    try:
        with one_line("config.yaml: "):
            read_yaml(ROOT / "config.yaml")
        if not os.access(ROOT, os.W_OK) and _starts():
            print_error(f"nothing can be written in {ROOT}: .venv is used as it is")
        else:
            with chdir(ROOT), locked():
                # Another process may have made it meanwhile.
                if not (_starts() and STAMP.read_text() == stamp):
                    _make()
                    write_whole(STAMP, stamp)
    except KeyboardInterrupt:
        with suppress(OSError):  # Popen, if interrupted, leaves the process that it has started
            for child in Path("/proc/thread-self/children").read_text().split():
                os.kill(int(child), signal.SIGKILL)
                os.waitpid(int(child), 0)
        print_error("interrupted: run it again to go on")
        sys.exit(130)
    except (UsageError, FileError, OSError) as error:
        print_error(str(error))
        sys.exit(1)
    os.execv(PYTHON, [PYTHON, "-P", "-m", "pipeline", *arguments])


def _starts() -> bool:
    """Return whether .venv is complete and its Python starts."""
    call = [PYTHON, "-I", "-S", "-c", ""]
    return STAMP.is_file() and bool(shutil.which(PYTHON)) and subprocess.call(call) == 0


def _make() -> None:
    """Make .venv from nothing; UsageError if there is one that ./reproduce did not make."""
    for folder in (str(ROOT), os.environ.get("PSEUDORIGID_WHEELS", "")):
        if refused := re.sub(r"[\w /.,+@=~()-]", "", folder):
            words = f"installers cannot take {refused[0]!r} in a folder's name"
            raise UsageError(f"{folder!r}: {words}")
    # A plain snakemake, in an environment of its own, keeps matplotlib's cache there.
    empty = VENV.is_dir() and {each.name for each in VENV.iterdir()} <= {"cache"}
    if VENV.is_symlink() or (VENV.exists() and not (empty or LOG.is_file())):
        raise UsageError(f"{VENV} was not made by ./reproduce: please move it away")
    removing = VENV.with_name(".venv.removing")
    shutil.rmtree(removing, ignore_errors=True)  # left by a killed run
    if VENV.exists():  # the new name first: a half-removed .venv could be taken for a user's
        VENV.rename(removing)
        shutil.rmtree(removing, ignore_errors=True)
    VENV.mkdir()
    LOG.touch()
    print_error("installing the locked packages into .venv (once)")
    _check(_run([sys.executable, "-I", "-m", "venv", "--without-pip", VENV]))
    _install("build", "lock")
    # Python reads it in the locale's encoding: a relative path is ASCII.
    write_whole(next(VENV.glob("lib/*/site-packages")) / "pseudorigid.pth", "../../../../src\n")


def _install(*names: str, again: bool = False) -> None:
    """Install requirements/NAME.txt of each name, by uv if possible, `again` if it is there."""
    pip = [PYTHON, "-I", "-m", "pip"]
    if not any(VENV.glob("lib/python3*/site-packages/pip")):  # it is installed with "build"
        if importlib.util.find_spec("pip"):
            pip = [sys.executable, "-I", "-m", "pip", f"--python={PYTHON}"]
        else:
            _check(_run([PYTHON, "-I", "-m", "ensurepip"]))
    environment = installers_environment(pip)
    options = ["--require-hashes", "--no-build-isolation"]
    ours = ROOT / "packages"  # of a tar with packages, which has only these lists
    archived = ours.is_dir() and {*names} & {"lock", *_ON_DEMAND.values()}
    folder = os.environ.get("PSEUDORIGID_WHEELS") or (archived and ours)
    if folder:
        options += ["--no-index", f"--find-links={folder}"]
    elif environment.get("PIP_NO_INDEX", "0").lower() in ("1", "true", "yes", "on"):
        options += ["--no-index"]

    def by_pip(name: str, *more: str) -> bool:
        command = [*pip, "install", "--no-compile", "--progress-bar=off", *options, *more]
        return _run([*command, "-r", f"requirements/{name}.txt"], environment)

    cache = VENV / "cache" / "uv"  # it is removed at the end, and uv with it
    shutil.rmtree(cache, ignore_errors=True)  # left by a killed run
    own = "--only-binary=:all:", "--retries=1", f"--target={cache}"
    uv = shutil.which("uv") or (cache / "bin" / "uv" if by_pip("uv", *own) else None)
    kept = "UV_CACHE_DIR" in environment  # its copy must not change with an edit of a package
    environment |= {"UV_LINK_MODE": "copy"} if kept else {"UV_CACHE_DIR": str(cache)}
    for name in names:
        command = [uv or "", "pip", "install", f"--python={PYTHON}", *options]
        command += [*["--reinstall"] * again, "-r", f"requirements/{name}.txt"]
        if not (uv and _run(command, environment)):
            _check(by_pip(name, *["--force-reinstall"] * again))
    shutil.rmtree(cache, ignore_errors=True)


def _run(command: Sequence[str | Path], environment: dict[str, str] | None = None) -> bool:
    """Run a command with its output in the log, and return whether it succeeded."""

    def progress() -> str:
        there = len([*VENV.glob("lib/*/site-packages/*.dist-info")])
        return f"reproduce: installing: packages so far: {there}"

    how: dict[str, Any] = {"stdin": subprocess.DEVNULL, "cwd": ROOT, "env": environment}
    with LOG.open("ab") as log, closing(Heartbeat(progress, gap=4.5)):
        # It inherits the lock.
        return subprocess.call(command, stdout=log, stderr=log, close_fds=False, **how) == 0


def _check(succeeded: bool) -> None:
    """Raise UsageError after a command that failed, with the last line of its log.

    For a package with a wrong hash, pip's last lines are its name, the expected and the found hash.
    """
    if not succeeded:
        log = LOG.read_text(errors="replace").rstrip()
        last = log.rpartition("\n")[2][:200]
        if damaged := re.search(r"(?m)^ +(\S+).*(\n +(Expected|or|Got) .*)+\Z", log):
            last = f"{damaged[1]} is damaged: its hash is not in requirements/"
        raise UsageError(f"could not install the packages: {last} (log: .venv/install.log)")


def installers_environment(pip: list[str]) -> dict[str, str]:
    """Return the environment for pip and uv, without variables that change what is installed.

    pip reads no file of settings in it: of these, variables have those that are kept. uv has pip's
    settings, each overridden by uv's of the same name.
    """
    dropped = r"PIP_|UV_|VIRTUAL_ENV$|CONDA_PREFIX$|SETUPTOOLS_|DISTUTILS_"
    neutral = {name: value for name, value in os.environ.items() if not re.match(dropped, name)}
    neutral["LC_ALL"] = "C.UTF-8"  # setuptools reads files in the locale's encoding
    variables = {name: f"PIP_{name.upper().replace('-', '_')}" for name in _SETTINGS}
    own = {"PIP_CONFIG_FILE", *variables.values()} & os.environ.keys()
    result = subprocess.run(
        [*pip, "config", "list"],
        capture_output=True,
        text=True,
        check=False,
        env=neutral | {name: os.environ[name] for name in own},
    )
    settings = re.findall(r"^(global|install|:env:)\.([\w-]+)=(.+)$", result.stdout, re.M)
    settings.sort(key=lambda item: ("global", "install", ":env:").index(item[0]))
    # As pip does, uv searches all indexes for a version; its hash decides what is installed.
    environment = neutral | {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    if ssl.get_default_verify_paths().cafile:
        environment["UV_SYSTEM_CERTS"] = "1"
    for _, name, value in settings:
        for variable in filter(None, [variables.get(name), _SETTINGS.get(name)]):
            environment[variable] = ast.literal_eval(value)
    environment |= {name: value for name, value in os.environ.items() if re.match(_UV, name)}
    environment |= {"PIP_CONFIG_FILE": os.devnull, "PIP_USER": "0", "PIP_NO_INPUT": "1"}
    return environment | {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}
