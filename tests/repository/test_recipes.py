"""The recipe of CONTRIBUTING for a kind of picture, followed in a copy: its tests are green."""

import os
import re
import shutil

import pytest

from helpers.project import ROOT, Tree, run
from helpers.verdicts import commit

KIND = '''

class Returns(OfOrbits):
    """the next position against the present one"""

    stages = ("orbits",)
    axes_depend_on = ("impacts",)
    headline = "orbits"

    axes: dict[Literal["x", "next"], Axis] = ABSENT
    """Limits and ticks of the axes `x` and `next` (positions, R)."""
'''
DRAWING = '''"""Next position against the present one."""

from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import complete, of_data
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas import style


@style.pinned()
def draw(scene: dict[str, Any], orbits: xr.Dataset) -> Figure:
    """Return the Figure of x' against x."""
    x = orbits["x"].values
    scene = complete(scene, x=lambda: of_data(x), next=lambda: of_data(x))
    picture = Plane(scene, ("x", "next"), ("Position $x$", "Next position $x'$"))
    picture.dots(x[:-1], x[1:], style.BLUE, 1.5)
    return picture.figure
'''
REPORT = '''

def returns(block: dict[str, Any], orbits: xr.Dataset) -> dict[str, str]:
    """Count the orbits."""
    return {"orbits": f"{orbits.sizes['orbit']}"}
'''
CAPTION = """
[kinds.returns]
shows = \"\"\"
The picture shows {{ s.starts|length|counted("orbit") }} at energy {{ s.energy }} for k =
{{ s.ball.k }}, g = {{ s.ball.g }}: the next position x' against the present one, x.\"\"\"
see = "A regular orbit is a closed line."
"""
EXAMPLE = """
returns:
  picture: returns
  ball: {k: 0.3, g: 0.02}
  energy: 0.001
  starts: [0.1]
  impacts: 300
"""
SCENE = """
  returns:
    picture: returns
    energy: 0.01
    starts: [0.1, 0.6]
    impacts: 300
    formats: [png, svg]
"""
PRESET = "  returns: (scene) => ({ orbits: orbitsOf(scene) }),\n"
TEST = '''"""Returns of orbits."""

from helpers.examples import checked, made


def test_orbits_are_counted():
    assert made(checked("returns"))[1] == {"orbits": "1"}
'''


# File of a step -> its text, from the one before.
EDITS = {
    "src/paper/figures/NAME.py": lambda text: DRAWING,
    "src/paper/figures/reports.py": lambda text: text + REPORT,
    "src/paper/kinds.py": lambda text: text + KIND,
    "src/paper/presets.js": lambda text: text.replace("PRESETS, {\n", f"PRESETS, {{\n{PRESET}", 1),
    "src/paper/captions.toml": lambda text: text + CAPTION,
    "src/paper/examples.yaml": lambda text: text + EXAMPLE,
    "tests/pseudorigid/figures/test_NAME.py": lambda text: TEST,
    "config.yaml": lambda text: text.replace("\nscenes:\n", f"\nscenes:{SCENE}", 1),
}
# Default tests that look at kinds of picture, scenes or files.
TESTS = ("pipeline/checks", "pipeline/config", "pseudorigid/figures/test_returns.py")
TESTS += ("paper", "repository", "extensions/explorer/test_generated.py")
TESTS += ("extensions/publication/test_figures_page.py",)


def steps():
    """What stands first in backquotes in each step of the list: a file, or a command."""
    _, _, rest = (ROOT / "CONTRIBUTING.md").read_text().partition("**A kind of picture**")
    return re.findall(r"^\d+\. `(.*?)`", rest.partition("**A stage.**")[0], re.MULTILINE)


def follow(tree, step):
    """Edit the file of a step, or run its command."""
    if edit := EDITS.get(step):
        file = tree.path / step.replace("NAME", "returns")
        file.write_text(edit(file.read_text() if file.exists() else ""))
    elif step.startswith("./reproduce"):
        words = step.split()[1:]
        given = ["-q", *(f"tests/{name}" for name in TESTS)] if words == ["test"] else []
        tree.succeed(*words, *given)
    else:
        command = step.replace(".venv/bin/python", tree.command()[0]).split()
        result = run(*command, cwd=tree.path, env=tree.environment())
        assert result.returncode == 0, result.stderr


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the project in a repository of its own."""
    for name in [name for name in os.environ if name.startswith("PYTEST_")]:
        monkeypatch.delenv(name)
    names = (".venv", ".git", "results", ".snakemake", "__pycache__", ".*_cache")
    shutil.copytree(ROOT, tmp_path / "copy", symlinks=True, ignore=shutil.ignore_patterns(*names))
    commit(tmp_path / "copy", ".")
    return Tree(tmp_path / "copy", cold=True)


@pytest.mark.slow
def test_a_kind_of_picture_that_was_added_by_the_list_leaves_the_tests_green(copy):
    assert [step for step in steps() if step in EDITS] == [*EDITS]
    for step in steps():
        if step.endswith("pipeline.renew"):
            assert_a_forgotten_preset_is_said(copy)
        follow(copy, step)
    assert (copy.path / "paper_figures/returns.png").is_file()


def assert_a_forgotten_preset_is_said(copy):
    file = copy.path / "src/paper/presets.js"
    text = file.read_text()
    file.write_text(text.replace(PRESET, ""))
    line = "presets.js has no returns: write it, or say on_section = False\n"
    assert copy.python("-m", "pipeline.renew").stderr == line
    file.write_text(text)
