"""Packages as files in a tar of the project, and the settings of pip that choose where they are."""

import ast
import hashlib
import os
import re
import subprocess
from pathlib import Path

from pipeline.cli.session import UsageError
from pipeline.records.sources import ROOT

FOLDER = "packages"  # of such a tar, unpacked; `reproduce` installs from it
# The settings of pip that are kept. Others could install elsewhere, or other packages.
_SETTINGS = "index-url extra-index-url find-links trusted-host cert client-cert proxy no-index "
_SETTINGS += "timeout default-timeout retries keyring-provider"
HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


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
    for line in [line for name in names for line in logical_lines(name)]:
        name, version = re.findall(r"^([\w.-]+)==([^\s;]+)", line)[0]
        form = re.sub(r"[-_.]+", "[-_.]", name) + rf"-{re.escape(version)}[-.](.*\.)?(whl|gz|zip)"
        for file in folder.iterdir():
            named = re.fullmatch(form, file.name, re.IGNORECASE)
            if named and file.is_file() and sha256_of(file) not in HASH.findall(line):
                raise UsageError(f"{file} is damaged: its hash is not in requirements/")


def logical_lines(name: str) -> list[str]:
    """Return the requirements of requirements/NAME.txt, each on one line."""
    text = (ROOT / "requirements" / f"{name}.txt").read_text(encoding="utf-8")
    lines = text.replace("\\\n", "").splitlines()
    return [" ".join(line.split()) for line in lines if re.match(r"[\w.-]+==", line)]


def sha256_of(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
