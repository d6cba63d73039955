"""The locked packages as files, which an archive carries for installations without a network.

`set_up` imports this module before any package is installed, so that `packaging` is imported late.
"""

import hashlib
import platform
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from ...records.sources import ROOT
from ..session import UsageError
from . import indexes

FOLDER = "packages"  # of an unpacked archive; `reproduce` installs from it
REQUIREMENTS = ("uv", "build", "lock")  # what an installation needs
_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")
_GLIBC = 28  # wheels for glibc 2.28 and older are taken for another machine


def download(folder: Path, python: str, machine: str | None) -> list[Path]:
    """Download the locked packages for a version of Python and a machine, and return the files.

    `python` is a version such as 3.13, `machine` a processor such as aarch64, or None for this one.
    Files that are in `folder` already are kept. A package without a wheel is downloaded as source.
    UsageError, with pip's own message, if that fails.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lines = [line for name in REQUIREMENTS for line in _requirements(name, python, machine)]
    pip = [sys.executable, "-I", "-m", "pip"]
    options = ["--no-deps", "--require-hashes", "--quiet", "--progress-bar=off"]
    options += [f"--dest={folder}", f"--python-version={python}"]
    if machine:  # pip tries only the tags that it is given
        options += [f"--platform=manylinux_2_{glibc}_{machine}" for glibc in range(_GLIBC, 4, -1)]
        options += [f"--platform=manylinux2014_{machine}", f"--platform=linux_{machine}"]
    with tempfile.TemporaryDirectory() as scratch:
        requirements = Path(scratch, "requirements.txt")
        requirements.write_text("\n".join(lines))
        result = subprocess.run(
            [*pip, "download", *options, "-r", str(requirements)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            env=indexes.pip_environment(indexes.pip_settings(pip)),
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


def _requirements(name: str, python: str, machine: str | None) -> list[str]:
    """Return the requirements that a machine needs, without their conditions.

    Pip would evaluate the conditions for the Python that runs it.
    """
    from packaging.markers import Marker

    target = {"python_version": python, "python_full_version": f"{python}.0"}
    target |= {"sys_platform": "linux", "platform_system": "Linux"}
    target["platform_machine"] = machine or platform.machine()
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
