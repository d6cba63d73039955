"""The science is a wheel of its own that works, with its types, without the repository."""

import os
import re
import shutil
import sys
import tarfile
import venv
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement

import pseudorigid
from helpers.pages import blocks
from helpers.project import NO_CACHES, ROOT, run


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


def build(kind, tree, folder):
    """Build the `wheel` or the `sdist` of a tree in another folder, and return its path."""
    program = f"from flit_core import buildapi; print(buildapi.build_{kind}({str(folder)!r}))"
    return folder / succeed(sys.executable, "-c", program, cwd=tree).strip()


@pytest.fixture(scope="module")
def sdist(tmp_path_factory):
    """The sdist, built from a copy of the sources."""
    tree = tmp_path_factory.mktemp("tree")
    for part in ("pyproject.toml", "LICENSE", "CHANGELOG.md", "CITATION.cff"):
        shutil.copy(ROOT / part, tree)
    for part in ("src", "docs", "tests"):
        shutil.copytree(ROOT / part, tree / part, ignore=NO_CACHES)
    return build("sdist", tree, tmp_path_factory.mktemp("sdist"))


@pytest.fixture(scope="module")
def unpacked(sdist, tmp_path_factory):
    """The folder of the unpacked sdist."""
    folder = tmp_path_factory.mktemp("unpacked")
    with tarfile.open(sdist) as archive:
        archive.extractall(folder, filter="data")
    (unpacked,) = folder.iterdir()
    return unpacked


@pytest.fixture(scope="module")
def wheel(unpacked, tmp_path_factory):
    """The wheel, built from the sdist."""
    file = build("wheel", unpacked, tmp_path_factory.mktemp("wheel"))
    names = zipfile.ZipFile(file).namelist()
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"pseudorigid"}
    return file


@pytest.fixture(scope="module")
def tools(tmp_path_factory):
    """An environment with the packages of requirements/wheel.txt, from a package index."""
    folder = tmp_path_factory.mktemp("tools")
    venv.create(folder, symlinks=True)
    uv = shutil.which(ROOT / ".venv" / "bin" / "uv") or shutil.which("uv")
    if uv is None:
        pytest.skip("uv is not installed")
    command = uv, "pip", "install", "-q", "--require-hashes", "-p", folder / "bin" / "python"
    result = run(*command, "-r", ROOT / "requirements" / "wheel.txt", env=os.environ)
    assert result.returncode == 0, result.stderr
    return folder


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
    present = {path.name.lower() for path in site.iterdir()}
    assert present & {"snakemake", "scipy", "sympy", "pytest", "pydantic"} == set()
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


@pytest.mark.slow
def test_an_index_would_show_the_description(sdist, wheel, tools):
    succeed(tools / "bin" / "twine", "check", "--strict", sdist, wheel, cwd=tools)


@pytest.mark.slow
def test_the_tests_of_the_sdist_need_no_workflow(unpacked, tmp_path):
    """They are collected without the folders of the workflow; .ci/packages runs them."""
    for name in ("CHANGELOG.md", "CITATION.cff", "docs/python.md"):
        assert (unpacked / name).read_bytes() == (ROOT / name).read_bytes()
    without = (
        "import sys; sys.modules |= dict.fromkeys(['pipeline', 'paper', 'study', 'extensions'])"
    )
    program = f"{without}; import pytest; sys.exit(pytest.main(['--collect-only', '-q']))"
    tests = succeed(sys.executable, "-P", "-c", program, cwd=unpacked)
    for folder in ("dynamics", "kernel", "figures", "verified"):
        assert f"tests/pseudorigid/{folder}/test_" in tests


@pytest.mark.slow
def test_a_zip_of_the_package_can_be_imported(wheel, environment, tmp_path):
    code = "import sys; sys.path[:0] = [{!r}]; import pseudorigid; print(pseudorigid.__file__); "
    code += "print(pseudorigid.Ball(0.2, 0.04).impact(0.4, 0.02, 0.1)[3])"
    path, tau = succeed(environment, "-I", "-c", code.format(str(wheel)), cwd=tmp_path).split()
    assert path.startswith(str(wheel))
    assert float(tau) == pseudorigid.Ball(0.2, 0.04).impact(0.4, 0.02, 0.1)[3]


@pytest.mark.slow
def test_an_import_that_fails_says_why(environment, tmp_path):
    """An older numba lacks an attribute; `from ... import` would hide which one."""
    code = "import numba; del numba.core.config.CACHE_LOCATOR_CLASSES; from pseudorigid import Ball"
    result = run(environment, "-I", "-c", code, cwd=tmp_path)
    last = result.stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: cannot import Ball: "), result.stderr
    assert "CACHE_LOCATOR_CLASSES" in last


def refused_lines(found, name):
    """The lines of a program with errors, from the output of a type checker."""
    return {int(line) for line in re.findall(rf"\b{name}:(\d+)(?::\d+)?(?: -|:) error", found)}


@pytest.mark.slow
@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_type_checkers_accept_documented_uses_and_refuse_mistakes(
    checker, environment, tools, tmp_path
):
    """In a program, in README.md and the page on Python, and in the examples of the documents."""
    examples = {file.name: file.read_text() for file in (ROOT / "docs" / "examples").glob("*.py")}
    programs = {name: text for name, text in examples.items() if "from extensions" not in text}
    for page in ("README.md", "docs/python.md"):
        code = [t for t in blocks(page) if re.match("from pseudorigid|import xarray", t)]
        programs[f"{Path(page).stem.lower()}_page.py"] = "\n".join(code)
    programs["uses.py"] = (ROOT / "tests" / "repository" / "typed_uses.py").read_text()
    for name, text in programs.items():
        (tmp_path / name).write_text(text)
    site, stubs = (next(f.glob("lib/*/site-packages")) for f in (environment.parents[1], tools))
    if not (site / "pandas-stubs").exists():
        (site / "pandas-stubs").symlink_to(stubs / "pandas-stubs")
    if checker == "mypy":
        command = sys.executable, "-m", "mypy", "--strict", "--python-executable", environment
    else:
        (tmp_path / "pyrightconfig.json").write_text('{"typeCheckingMode": "standard"}')
        command = tools / "bin" / "basedpyright", "--pythonpath", environment
    found = run(*command, *programs, cwd=tmp_path).stdout
    for name, text in programs.items():
        lines = enumerate(text.splitlines(), 1)
        expected = {number for number, line in lines if line.endswith("# refused")}
        assert refused_lines(found, name) == expected, (name, found)
    assert "import-untyped" not in found and "could not be resolved" not in found
