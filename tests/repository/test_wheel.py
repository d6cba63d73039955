"""The science is a wheel of its own that works, with its types, without the repository."""

import re
import shutil
import sys
import venv
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from project import NO_CACHES, ROOT, run
from test_documents import blocks

import pseudorigid


def succeed(*command, cwd, **environment):
    """Run a command that must succeed, without this process's environment; what it prints."""
    usual = {"PATH": "/usr/bin:/bin", "HOME": str(cwd)}
    result = run(*command, cwd=cwd, env=usual | environment)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def demanded(distribution):
    """A distribution's requirements without extras, with theirs, by name."""
    found, waiting = {}, [distribution]
    while waiting:
        for line in waiting.pop().requires or ():
            requirement = Requirement(line)
            marker = requirement.marker
            if requirement.name not in found and (not marker or marker.evaluate({"extra": ""})):
                found[requirement.name] = metadata.distribution(requirement.name)
                waiting.append(found[requirement.name])
    return found


def files_of(distributions):
    """The files and folders in site-packages that belong to distributions."""
    for distribution in distributions.values():
        for name in {file.parts[0] for file in distribution.files} - {"..", "__pycache__"}:
            yield Path(distribution.locate_file(name))


# Prints how many examples of a page fail, and which modules cannot be imported.
MODULES = """
import importlib, pkgutil, pseudorigid
def fails(name):
    try: importlib.import_module(name)
    except ImportError: return True
modules = pkgutil.walk_packages(pseudorigid.__path__, "pseudorigid.")
print([n for _, n, _ in modules if fails(n) and ".verified." not in n])
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel, built from a copy of the sources."""
    folder = tmp_path_factory.mktemp("wheel")
    for part in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / part, folder)
    shutil.copytree(ROOT / "src", folder / "src", ignore=NO_CACHES)
    pip = (sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-index", "--no-build-isolation")
    succeed(*pip, "-w", folder, ".", cwd=folder)
    (file,) = folder.glob("pseudorigid-*.whl")
    names = zipfile.ZipFile(file).namelist()
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"pseudorigid"}
    return file


@pytest.fixture(scope="module")
def environment(wheel, tmp_path_factory):
    """A Python that sees the wheel and what its metadata demand, and no other package."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, symlinks=True)
    (site,) = folder.glob("lib/python*/site-packages")
    zipfile.ZipFile(wheel).extractall(site)
    (ours,) = metadata.distributions(path=[str(site)])
    for path in files_of(demanded(ours)):
        (site / path.name).symlink_to(path)
    assert not (site / "netCDF4").exists() and not (site / "pytest").exists()
    return folder / "bin" / "python"


@pytest.mark.slow
def test_the_wheel_works_without_the_repository(wheel, environment, tmp_path):
    def python(code):
        return succeed(environment, "-I", "-c", code, cwd=tmp_path)

    (snippet,) = (text for text in blocks("README.md") if text.startswith("from pseudorigid"))
    code = f"{snippet}\nimport importlib.util, pseudorigid\nprint(pseudorigid.__file__)\n"
    code += "print(float(hyperbolic.multiplier), pseudorigid.__version__)\n"
    code += "print(importlib.util.find_spec('pipeline'))"
    path, multiplier, version, pipeline = python(code).split()
    assert path.startswith(str(environment.parents[1])) and pipeline == "None"
    assert version == pseudorigid.__version__ == wheel.name.split("-")[1]
    assert f"its multiplier is {float(multiplier):.4f}" in snippet
    assert python(MODULES).split() == ["[]"]


# Lines of a program, each with a mistake, and the code of mypy's error.
WRONG = {
    "orbit(ball, state, impact=3)": "call-arg", "orbit(ball, state)": "call-arg",
    "orbit((0.2, 0.04), state, 3)": "arg-type", "orbit(ball, 0.4, 3)": "arg-type",
    "Ball('0.2', 0.04)": "arg-type", "ball.k = 0.3": "misc", "ball.impacts(*state)": "attr-defined",
    "ball.start(None, 0.01)": "arg-type", "symmetric_orbits(ball, '0.01', 6)": "arg-type",
    "trace_manifold(ball, 0.01, six, 0, False)": "call-arg",
    "lyapunov_spectrum(ball, state, impacts=[3])": "arg-type",
    "rotation_number(ball, None)": "arg-type", "residue(3)": "arg-type",
    "motion(ball, state, '16')": "arg-type", "Picture([0, 1])": "call-arg",
    "Picture([0, 1], [0, 1], names='xy')": "arg-type", "picture.dots([0, 1], [0, 1])": "call-arg",
    "picture.dot([0, 1], [0, 1], 'red')": "attr-defined", "picture.save(3)": "arg-type",
    "pseudorigid.orbits": "attr-defined",
}  # fmt: skip
RIGHT = """
from fractions import Fraction
from pathlib import Path

import numpy as np
import xarray as xr
import pseudorigid
from pseudorigid import *

shell = Ball(Fraction(1, 3), g=np.float64(0.04))
ball: Ball = Ball(k=shell.k / 2, g=0.04)
x, xdot, udot, tau = ball.impact(0.4, 0.02, np.array(0.1))
ratio: float = round(tau, 6) / ball.k
state = ball.start([0.5, -0.2], 0.01)
state = ball.start([[0.5], (Fraction(1, 2),)], energy=np.linspace(0.01, 0.02, 3))
many: xr.Dataset = orbit(ball, (np.zeros(3), 0.1, [0.1, 0.2, Fraction(1, 3)]), 3, keep="last")
orbit(ball, many, impacts=int(many["x"].size))
orbit(ball, [0.1, 0.1, 0.1], 3)
orbit(ball, np.full((3, 2), 0.1), 3)
orbit(ball, (many["x"], many["xdot"], many["udot"]), 3)
for side in ("inner", "outer"):
    line = trace_manifold(ball, 0.01, symmetric_orbits(ball, 0.01, 6).isel(orbit=1), side=side)
picture = Picture(many["x"], -many["udot"], ("a", "b"), title="c")
picture.line(range(2), [0, 1], "label", color="red", lw=2)
picture.save(Path("a.png")).save("a.svg").figure.set_facecolor("red")
number: xr.DataArray = residue(symmetric_orbits(ball, 0.01, 6))
version: str = pseudorigid.__version__
"""


@pytest.mark.slow
def test_mypy_knows_the_types_of_the_wheel(environment, tmp_path):
    """In users' programs, in README.md, and in the examples of the documents."""
    (snippet,) = (text for text in blocks("README.md") if text.startswith("from pseudorigid"))
    examples = {file.stem: file.read_text() for file in (ROOT / "docs" / "examples").glob("*.py")}
    programs = {name: text for name, text in examples.items() if "from extensions" not in text}
    programs |= {"right": RIGHT, "readme": snippet}
    opening = "import pseudorigid\nfrom pseudorigid import *\nball = Ball(0.2, 0.04)\n"
    opening += "state, six = ball.start(0.4, 0.01), symmetric_orbits(ball, 0.01, 6).isel(orbit=1)\n"
    opening += "picture = Picture([0, 1], [0, 1])\n"
    programs["wrong"] = opening + "\n".join(WRONG)
    for name, text in programs.items():
        (tmp_path / f"{name}.py").write_text(text)
    mypy = (sys.executable, "-m", "mypy", "--strict", "--python-executable", environment)
    found = run(*mypy, *(f"{name}.py" for name in programs), cwd=tmp_path).stdout
    pattern = r"^(\w+)\.py:(\d+): error: .*\[(.*)\]$"
    errors = {(name, int(line)): code for name, line, code in re.findall(pattern, found, re.M)}
    first = opening.count("\n") + 1
    expected = {("wrong", line): code for line, code in enumerate(WRONG.values(), first)}
    assert errors == expected, found
