"""The study's charts in verify and accept: those of our own arithmetic, once they are committed."""

import os
import re
import shutil
import subprocess
import sys

import netCDF4
import numpy as np
import pytest
import xarray as xr
from verdicts import say

from pipeline import config
from pipeline.checks import contract, manifest
from pipeline.checks.verify import accept, verify
from pipeline.config import study as parts
from pipeline.records import artifacts, provenance
from pseudorigid.dynamics.ball import Ball
from pseudorigid.figures.canvas.render import png

CHARTS = ("work_uniform", "work_grazing", "edges", "energy", "apart", "needs")


@pytest.fixture
def studied(moved, monkeypatch):
    """The copy of a finished tree, with stand-ins for the study's data and charts."""
    monkeypatch.chdir(moved.path)
    scenes = config.load(moved.path / "config.yaml")["scenes"]
    about = {"long_name": "numbers", "units": "1"}
    for path, maker in contract.study(scenes).makers.items():
        record = provenance.begin(config=maker.config, inputs=[], sources=maker.sources)
        if path.endswith(".nc"):
            data = xr.Dataset({"numbers": ("place", np.arange(3000.0), about)})
            how = {"stage": "study", "ball": Ball(0.2, 0.04), "energy": 0.01, "config": {}}
            artifacts.save(data, path, **how)
        else:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            image = np.full((4, len(path), 3), 200, dtype=np.uint8)
            with open(path, "wb") as file:
                file.write(png(image, 300))
        provenance.finish(record, path, provenance.record_path(path))
    os.mkdir(parts.FOLDER)
    for chart in CHARTS:
        shutil.copy(parts.drawn(chart), parts.published(chart))
    shutil.copy(parts.drawn("edges"), parts.published("seconds_uniform"))  # a measured one
    return moved


@pytest.fixture
def committed(studied):
    status, text = say(accept, studied)
    assert status == 0, text
    assert text.splitlines() == [
        "nothing changed",
        "a new contract (study_figures/MANIFEST.json: missing)",
        "study_figures/SHA256SUMS and study_figures/MANIFEST.json renewed: 6 charts",
    ]
    return studied


def words(tree):
    """(chart -> verdict where not identical, other lines of the study's part) of verify."""
    status, text = say(verify, tree)
    lines = re.split(r"figures identical.*\n", text)[1].splitlines()
    verdicts = dict(line.split(None, 1) for line in lines[: len(CHARTS)])
    assert [name.removesuffix(".png") for name in verdicts] == list(CHARTS)
    found = {name: v for name, v in verdicts.items() if v != "identical"}
    assert status == (0 if lines[-1] == "6 of 6 charts identical" else 1)
    return found, lines[len(CHARTS) + 1 :]


def test_every_chart_that_is_computed_has_a_contract():
    charts = {name for name, (data, *_) in parts.CHARTS.items() if data in parts.FIXED}
    assert charts == set(CHARTS)


def test_without_a_contract_nothing_is_said_of_the_study(studied):
    status, text = say(verify, studied)
    assert status == 0
    assert text.splitlines()[-1] == "11 of 11 figures identical"


def test_charts_as_accepted(committed):
    assert words(committed) == ({}, ["6 of 6 charts identical"])
    assert say(accept, committed)[1].splitlines() == [
        "nothing changed",
        "study_figures: nothing changed",
    ]
    command = [shutil.which("sha256sum") or pytest.skip("no sha256sum"), "--strict", "-c"]
    subprocess.run([*command, manifest.SUMS], cwd=parts.FOLDER, check=True, capture_output=True)


def test_measured_charts_are_no_part_of_it(committed):
    for change in (lambda path: path.write_bytes(b"x"), lambda path: path.unlink()):
        change(committed.path / parts.published("seconds_uniform"))
        assert words(committed) == ({}, ["6 of 6 charts identical"])


def test_another_number(committed):
    with netCDF4.Dataset(committed.path / "results" / "study" / "edges.nc", "a") as file:
        file["numbers"][2000] = 7.0
    found, rest = words(committed)
    said = "data: results/study/edges.nc: variable numbers differs from block 1 on"
    assert found == {"edges.png": f"{said} (value 1,024 of 3,000)"}
    assert rest == ["5 of 6 charts identical"]


def test_another_pixel(committed):
    path = committed.path / parts.published("apart")
    path.write_bytes(png(np.zeros((4, 33, 3), dtype=np.uint8), 300))
    found, _ = words(committed)
    assert found["apart.png"].startswith("drawing: study_figures/apart.png: ")


def test_a_scene_is_looked_at_by_one_chart_alone(committed):
    committed.edit("fig7", impacts=61)
    found, rest = words(committed)
    assert list(found) == ["needs.png"]
    assert found["needs.png"].startswith("config: scenes.fig7.impacts: 60 in the manifest, 61 in")
    assert rest[0].startswith("results/study/needs.nc: made from another config: ")


def test_results_that_are_not_there(committed):
    shutil.rmtree(committed.path / "results" / "study")
    assert words(committed) == (
        {},
        [
            "no results here: only the committed files were checked "
            "(./reproduce study makes the rest)",
            "6 of 6 charts identical",
        ],
    )
    before = (committed.path / parts.FOLDER / manifest.SUMS).read_bytes()
    assert say(accept, committed) == (0, "nothing changed\n")
    assert (committed.path / parts.FOLDER / manifest.SUMS).read_bytes() == before


def test_stale_results_are_not_accepted(committed):
    os.unlink(committed.path / "results" / "study" / "work.nc")
    status, text = say(accept, committed)
    assert (status, text.splitlines()[-1]) == (
        0,
        "study_figures stays as it is: results/study/work.nc is missing: "
        "run ./reproduce study first",
    )


def test_the_rules_know_the_results_of_the_contract(moved):
    """A dry run plans them with their records; the study's packages are not needed for that."""
    target = parts.drawn("apart")
    assert moved.planned(target) >= {target, parts.data("orbits")}
    assert sys.modules.get("flint") is None
