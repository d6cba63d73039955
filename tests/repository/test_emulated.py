"""Emulated processors give the bytes of all published figures of the paper.

    ./reproduce test -m emulated    # takes minutes

The tests need Debian's qemu-user. For aarch64 they also need apt with its packages
(dpkg --add-architecture arm64, apt-get update), from which a Python 3.11 is unpacked, and the
package index, for wheels with the versions and hashes in requirements/lock.txt. Nothing is
installed. A test whose requirements are missing is skipped with the reason.
"""

import json
import os
import shutil
import sys
import zipfile

import pytest

from helpers.project import ROOT, run
from pipeline.checks.published_sets import read_sums

pytestmark = [pytest.mark.emulated, pytest.mark.timeout(0)]  # they take long

SEARCHED = str(ROOT / "src"), str(ROOT / "tests")
DEBIAN = """
    libbz2-1.0 libc6 libcrypt1 libdb5.3 libexpat1 libffi8 libgcc-s1 liblzma5 libncursesw6 libnsl2
    libpython3.11-minimal libpython3.11-stdlib libreadline8 libsqlite3-0 libssl3 libstdc++6
    libtinfo6 libtirpc3 libuuid1 python3.11 python3.11-minimal zlib1g
"""


def require(*tools):
    for tool in tools:
        if shutil.which(tool) is None:
            pytest.skip(f"no {tool} here")


def run_or_skip(*command, cwd):
    result = run(*command, cwd=cwd)
    if result.returncode:
        last = (result.stderr.strip().splitlines() or ["?"])[-1]
        pytest.skip(f"{command[0]} {command[1]}: {last}")


@pytest.fixture(scope="module")
def nehalem():
    """An x86-64 processor without AVX and FMA."""
    require("qemu-x86_64")
    return ["qemu-x86_64", "-cpu", "Nehalem", sys.executable], {}


@pytest.fixture(scope="module")
def aarch64(tmp_path_factory):
    """An aarch64 processor with a Python and packages of its own."""
    require("qemu-aarch64", "apt-get", "dpkg")
    folder = tmp_path_factory.mktemp("aarch64")
    debs = folder / "debs"
    debs.mkdir()
    run_or_skip("apt-get", "download", *(f"{name}:arm64" for name in DEBIAN.split()), cwd=debs)
    for package in debs.iterdir():
        run_or_skip("dpkg", "-x", package, folder / "root", cwd=folder)
    platforms = [f"--platform=manylinux_2_{glibc}_aarch64" for glibc in range(28, 4, -1)]
    pip = [sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--require-hashes"]
    options = ["--python-version=3.11", *platforms, "--platform=manylinux2014_aarch64"]
    lock = str(ROOT / "requirements" / "lock.txt")
    run_or_skip(*pip, *options, "-d", str(folder / "packages"), "-r", lock, cwd=folder)
    for wheel in (folder / "packages").glob("*.whl"):
        zipfile.ZipFile(wheel).extractall(folder / "site")
    python = folder / "root" / "usr" / "bin" / "python3.11"
    command = ["qemu-aarch64", "-L", str(folder / "root"), str(python), "-s"]
    return command, {"PYTHONPATH": os.pathsep.join([*SEARCHED, str(folder / "site")])}


@pytest.fixture(scope="module", params=["nehalem", "aarch64"])
def machine(request):
    return request.getfixturevalue(request.param)


def test_the_published_figures(machine, tmp_path):
    python, environment = machine
    caches = {"NUMBA_CACHE_DIR": str(tmp_path), "MPLCONFIGDIR": str(tmp_path)}
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(SEARCHED)} | caches | environment
    result = run(*python, ROOT / "tests/helpers/paper_probe.py", env=environment)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout) == read_sums(ROOT, "paper_figures")
