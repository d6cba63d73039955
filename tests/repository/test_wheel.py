"""The science as a wheel of its own, in somebody else's project."""

import shutil
import subprocess
import sys
import textwrap
import zipfile

import pytest
from project import NO_CACHES, ROOT

import pseudorigid

PARTS = ("pyproject.toml", "README.md", "LICENSE", "src")


def run(*command, cwd, **environment):
    return subprocess.run(
        [*map(str, command)],
        cwd=cwd,
        env={"PATH": "/usr/bin:/bin", "HOME": str(cwd), **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_the_wheel_works_without_the_repository(tmp_path):
    clone = tmp_path / "clone"
    clone.mkdir()
    for part in PARTS:
        if (ROOT / part).is_dir():
            shutil.copytree(ROOT / part, clone / part, ignore=NO_CACHES)
        else:
            shutil.copy(ROOT / part, clone / part)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    offline = ("--no-build-isolation", "--no-deps", "--no-index")
    before = {path.name for path in clone.rglob("*")}
    built = run(*pip, "wheel", *offline, "-w", tmp_path, ".", cwd=clone)
    assert built.returncode == 0, built.stdout + built.stderr
    (wheel,) = tmp_path.glob("pseudorigid-*.whl")
    assert {path.name for path in clone.rglob("*")} == before
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"pseudorigid"}

    # An environment of its own that sees the locked packages, and nothing of this repository.
    away = tmp_path / "elsewhere"
    made = run(sys.executable, "-m", "venv", "--without-pip", away, cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    python = away / "bin" / "python"
    (site,) = away.glob("lib/python*/site-packages")
    (locked,) = (ROOT / ".venv").glob("lib/python*/site-packages")
    for package in locked.iterdir():
        if not package.name.startswith(("pseudorigid", "__editable__", "__pycache__")):
            (site / package.name).symlink_to(package)
    installed = run(*pip, "install", "--no-index", "--no-deps", "--target", site, wheel, cwd=away)
    assert installed.returncode == 0, installed.stderr

    text = (ROOT / "README.md").read_text(encoding="utf-8").partition("## From Python\n\n")[2]
    snippet = textwrap.dedent(text.partition("\n\n`pip install")[0])
    where = "import pseudorigid; print(pseudorigid.__file__, float(hyperbolic.multiplier))\n"
    where += "print(pseudorigid.__version__)"
    shown = run(python, "-c", f"{snippet}\n{where}", cwd=away)
    assert shown.returncode == 0, shown.stderr
    place, multiplier, version = shown.stdout.split()
    assert version == pseudorigid.__version__ == wheel.name.split("-")[1]
    assert place.startswith(str(site))
    assert f"its multiplier is {float(multiplier):.4f}" in snippet
    absent = run(python, "-c", "import pipeline", cwd=away)
    assert absent.returncode == 1
    assert "No module named 'pipeline'" in absent.stderr
