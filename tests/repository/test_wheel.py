"""The science is a wheel of its own that works without the repository."""

import shutil
import sys
import zipfile

import pytest
from project import NO_CACHES, ROOT, run
from test_documents import blocks

import pseudorigid


def succeed(*command, cwd):
    """Run a command that must succeed, without this process's environment; what it prints."""
    result = run(*command, cwd=cwd, env={"PATH": "/usr/bin:/bin", "HOME": str(cwd)})
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.mark.slow
def test_the_wheel_works_without_the_repository(tmp_path):
    clone = tmp_path / "clone"
    clone.mkdir()
    for part in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / part, clone)
    shutil.copytree(ROOT / "src", clone / "src", ignore=NO_CACHES)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    offline = ("--no-deps", "--no-index")
    before = set(clone.rglob("*"))
    succeed(*pip, "wheel", *offline, "--no-build-isolation", "-w", tmp_path, ".", cwd=clone)
    (wheel,) = tmp_path.glob("pseudorigid-*.whl")
    assert set(clone.rglob("*")) == before
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"pseudorigid"}

    # An environment of its own that sees the locked packages, and nothing of this repository.
    elsewhere = tmp_path / "elsewhere"
    succeed(sys.executable, "-m", "venv", "--without-pip", elsewhere, cwd=tmp_path)
    (site,) = elsewhere.glob("lib/python*/site-packages")
    (locked,) = (ROOT / ".venv").glob("lib/python*/site-packages")
    for package in locked.iterdir():
        if not package.name.startswith(("pseudorigid", "__editable__", "__pycache__")):
            (site / package.name).symlink_to(package)
    succeed(*pip, "install", *offline, "--target", site, wheel, cwd=elsewhere)

    (snippet,) = (text for text in blocks("README.md") if text.startswith("from pseudorigid"))
    code = f"{snippet}\nimport importlib.util, pseudorigid\nprint(pseudorigid.__file__)\n"
    code += "print(float(hyperbolic.multiplier), pseudorigid.__version__)\n"
    code += "print(importlib.util.find_spec('pipeline'))"
    printed = succeed(elsewhere / "bin" / "python", "-c", code, cwd=elsewhere)
    path, multiplier, version, pipeline = printed.split()
    assert path.startswith(str(site)) and pipeline == "None"
    assert version == pseudorigid.__version__ == wheel.name.split("-")[1]
    assert f"its multiplier is {float(multiplier):.4f}" in snippet
