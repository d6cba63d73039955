"""Packages as files, which an archive carries, and the settings of pip that choose where they are.

`set_up` imports this module before any package is installed, so that `packaging` is imported late.
"""

import ast
import hashlib
import os
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from ...records.sources import ROOT
from ..session import UsageError

FOLDER = "packages"  # of an unpacked archive; `reproduce` installs from it
REQUIREMENTS = ("uv", "build", "lock")  # what an installation needs
# The settings of pip that are kept. Others could install elsewhere, or other packages.
_SETTINGS = "index-url extra-index-url find-links trusted-host cert client-cert proxy no-index "
_SETTINGS += "timeout default-timeout retries keyring-provider"
_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


def download(folder: Path, python: str) -> list[Path]:
    """Download the locked packages for a version of Python, such as 3.13, and return the files.

    Files that are in `folder` already are kept. A package without a wheel is downloaded as source.
    UsageError, with pip's own message, if that fails.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lines = [line for name in REQUIREMENTS for line in _requirements(name, python)]
    pip = [sys.executable, "-I", "-m", "pip"]
    options = ["--no-deps", "--require-hashes", "--quiet", "--progress-bar=off"]
    options += [f"--dest={folder}", f"--python-version={python}"]
    with tempfile.TemporaryDirectory() as scratch:
        requirements = Path(scratch, "requirements.txt")
        requirements.write_text("\n".join(lines))
        result = subprocess.run(
            [*pip, "download", *options, "-r", str(requirements)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            env=pip_environment(pip_settings(pip)),
        )
    if result.returncode:
        errors = [line for line in result.stderr.splitlines() if line.startswith("ERROR: ")]
        message = (errors or result.stderr.splitlines() or ["pip failed"])[-1]
        raise UsageError(f"cannot download the packages: {message.removeprefix('ERROR: ')}")
    wanted = set(_HASH.findall("\n".join(lines)))
    files = [file for file in sorted(folder.iterdir()) if _sha256(file) in wanted]
    if len(files) != len(lines):
        raise UsageError(f"{folder} has {len(files)} packages of {len(lines)}: delete it and retry")
    return files


def pip_settings(pip: list[str]) -> dict[str, str]:
    """Return the settings of pip that are kept; variables override its files."""
    kept = ["PIP_CONFIG_FILE", *map(_variable, _SETTINGS.split())]
    own = {name: os.environ[name] for name in os.environ if name in kept}
    command, environment = [*pip, "config", "list"], neutral_environment() | own
    result = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    settings = re.findall(r"^(global|install|:env:)\.([\w-]+)=(.+)$", result.stdout, re.M)
    settings.sort(key=lambda item: ("global", "install", ":env:").index(item[0]))
    return {
        name: ast.literal_eval(value) for _, name, value in settings if name in _SETTINGS.split()
    }


def _variable(setting: str) -> str:
    return f"PIP_{setting.upper().replace('-', '_')}"


def neutral_environment() -> dict[str, str]:
    """Return the present environment without variables that change what is installed, or where."""
    dropped = r"PIP_|UV_|VIRTUAL_ENV$|CONDA_PREFIX$|SETUPTOOLS_|DISTUTILS_"
    kept = {name: value for name, value in os.environ.items() if not re.match(dropped, name)}
    return kept | {"LC_ALL": "C.UTF-8"}  # setuptools reads files in the locale's encoding


def pip_environment(settings: dict[str, str]) -> dict[str, str]:
    """Return the environment for pip, in which it reads no file of settings."""
    kept = {_variable(name): value for name, value in settings.items()}
    kept |= {"PIP_CONFIG_FILE": os.devnull, "PIP_USER": "0", "PIP_NO_INPUT": "1"}
    return neutral_environment() | kept | {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def refuse_damaged(folder: Path) -> None:
    """Raise UsageError for a file that has the name of a locked package and other bytes."""
    names = [file.stem for file in sorted((ROOT / "requirements").glob("*.txt"))]
    for line in [line for name in names for line in _logical_lines(name)]:
        name, version = re.findall(r"^([\w.-]+)==([^\s;]+)", line)[0]
        form = re.sub(r"[-_.]+", "[-_.]", name) + rf"-{re.escape(version)}[-.](.*\.)?(whl|gz|zip)"
        for file in folder.iterdir():
            named = re.fullmatch(form, file.name, re.IGNORECASE)
            if named and file.is_file() and _sha256(file) not in _HASH.findall(line):
                raise UsageError(f"{file} is damaged: its hash is not in requirements/")


def _requirements(name: str, python: str) -> list[str]:
    """Return the requirements for a version of Python on this machine, without their conditions.

    Pip would evaluate the conditions for the Python that runs it.
    """
    from packaging.markers import Marker

    target = {"python_version": python, "python_full_version": f"{python}.0"}
    target |= {"sys_platform": "linux", "platform_system": "Linux"}
    target["platform_machine"] = platform.machine()
    needed = []
    for line in _logical_lines(name):
        pin, _, marker = line.partition(" --hash")[0].partition(";")
        if not marker or Marker(marker.strip()).evaluate(target):
            hashes = " ".join(f"--hash=sha256:{digest}" for digest in _HASH.findall(line))
            needed.append(f"{pin.strip()} {hashes}")
    return needed


def _logical_lines(name: str) -> list[str]:
    """Return the requirements of requirements/NAME.txt, each on one line."""
    text = (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8")
    lines = text.replace("\\\n", "").splitlines()
    return [" ".join(line.split()) for line in lines if re.match(r"[\w.-]+==", line)]


def _sha256(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
