"""Environments of validators, whose requirements exclude those of the project."""

import subprocess
import sys

import pytest

from pipeline.records.sources import ROOT


@pytest.fixture(scope="session")
def environment_of(tmp_path_factory):
    """Return a function: name -> the Python of a new environment with requirements/NAME.txt."""

    def make(name):
        folder = tmp_path_factory.mktemp(name)
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        python = folder / "bin" / "python"
        pip = [python, "-m", "pip", "install", "-q", "--only-binary=:all:", "--require-hashes"]
        if subprocess.run([*pip, "-r", ROOT / f"requirements/{name}.txt"], check=False).returncode:
            pytest.skip(f"the packages of requirements/{name}.txt could not be installed")
        return python

    return make
