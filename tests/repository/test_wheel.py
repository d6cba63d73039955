"""The science is a wheel of its own that works without the repository."""

import shutil
import sys
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
EXAMPLES = """
import doctest, importlib, pkgutil, pseudorigid
def fails(name):
    try: importlib.import_module(name)
    except ImportError: return True
print(doctest.testfile("{page}", module_relative=False).failed)
modules = pkgutil.walk_packages(pseudorigid.__path__, "pseudorigid.")
print([n for _, n, _ in modules if fails(n)])
"""


@pytest.mark.slow
def test_the_wheel_works_without_the_repository(tmp_path):
    clone = tmp_path / "clone"
    clone.mkdir()
    for part in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / part, clone)
    shutil.copytree(ROOT / "src", clone / "src", ignore=NO_CACHES)
    pip = (sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-index", "--no-build-isolation")
    succeed(*pip, "-w", tmp_path, ".", cwd=clone)
    (wheel,) = tmp_path.glob("pseudorigid-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"pseudorigid"}

    # A Python that sees the wheel and what its metadata demand, and no other package.
    site = tmp_path / "site"
    zipfile.ZipFile(wheel).extractall(site)
    (ours,) = metadata.distributions(path=[str(site)])
    for path in files_of(demanded(ours)):
        (site / path.name).symlink_to(path)
    assert not (site / "netCDF4").exists() and not (site / "pytest").exists()

    def python(code):
        return succeed(sys.executable, "-S", "-c", code, cwd=site, PYTHONPATH=str(site))

    (snippet,) = (text for text in blocks("README.md") if text.startswith("from pseudorigid"))
    code = f"{snippet}\nimport importlib.util, pseudorigid\nprint(pseudorigid.__file__)\n"
    code += "print(float(hyperbolic.multiplier), pseudorigid.__version__)\n"
    code += "print(importlib.util.find_spec('pipeline'))"
    path, multiplier, version, pipeline = python(code).split()
    assert path.startswith(str(site)) and pipeline == "None"
    assert version == pseudorigid.__version__ == wheel.name.split("-")[1]
    assert f"its multiplier is {float(multiplier):.4f}" in snippet
    page = tmp_path / "api.md"
    page.write_text((ROOT / "docs" / "api.md").read_text().partition("\n## Functions of ext")[0])
    assert python(EXAMPLES.format(page=page)).split() == ["0", "[]"]
