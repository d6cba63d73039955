"""The scripts of docs/examples make the pictures beside them."""

import json
import re
import runpy

import matplotlib
import numpy as np
import pytest

from helpers.colours import assert_colours_apart
from helpers.project import ROOT
from helpers.slowly import slowly
from pipeline.declaration import parts
from pipeline.records import artifacts
from pseudorigid import Ball, Picture
from pseudorigid.dynamics.orbits import scene_orbits

FOLDER = ROOT / "docs" / "examples"
SCRIPTS = sorted(file.stem for file in FOLDER.glob("*.py"))


def save_orbits_of_figure_2(folder):
    manifest = json.loads((ROOT / "paper_figures" / "MANIFEST.json").read_text(encoding="utf-8"))
    scene = manifest["results"]["results/paper/figures/fig2.png"]["config"]
    data = scene_orbits(Ball(**scene["ball"]), scene["energy"], scene["starts"], scene["impacts"])
    artifacts.save(data, folder / "results" / "paper" / "orbits_fig2.nc", {})


DEAR = "bifurcation", "scan"  # they take seconds


@pytest.mark.parametrize("name", [*slowly(*DEAR), *(s for s in SCRIPTS if s not in DEAR)])
def test_a_script_makes_its_picture(name, tmp_path, monkeypatch):
    script = FOLDER / f"{name}.py"
    imported = re.findall(r"^from extensions\.(\w+)", script.read_text(encoding="utf-8"), re.M)
    if missing := {*imported} - {*parts()}:
        pytest.skip(f"{name} needs the extension {missing}")
    if name == "dataset":
        save_orbits_of_figure_2(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert_colours_apart(runpy.run_path(str(script))["picture"].figure)
    made = (tmp_path / f"{name}.png").read_bytes()
    assert made == (FOLDER / f"{name}.png").read_bytes()


def test_a_picture_ignores_settings_and_is_shown_by_a_notebook(tmp_path):
    def draw():
        picture = Picture([0, 1], [0, 2], ("$x$", "value"), "A title")
        picture.line([0, 1], [0, 2], "a line", color="#0072b2")
        picture.line([0, 1], [1, 2], "a line", color="#d55e00")  # named once
        picture.estimates(*np.array([[0.2, 0.5], [0.1, 0.2], [0.0, 0.1], [0.2, 0.3]]), "#0072b2")
        picture.note(0.5, 1.0, "a note")
        return picture

    with matplotlib.rc_context({"font.family": "monospace", "lines.solid_capstyle": "round"}):
        saved = draw().save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == draw()._repr_png_() == saved._repr_png_()
    assert draw().render("svg").count(b"<svg ") == 1
