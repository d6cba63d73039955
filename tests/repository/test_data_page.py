"""Datasets describe themselves; docs/data.md has their stages and attributes, its examples run."""

import re

import numpy as np
import pytest
import xarray as xr
from test_documents import blocks, text_of

from pipeline.config.schema.stages import STAGES
from pipeline.records import artifacts
from pseudorigid import Ball, lyapunov_spectrum, orbit, symmetric_orbits, trace_manifold
from pseudorigid.dynamics.orbits import scene_orbits
from study import figure_errors, measured, stages
from study.methods.counted_methods import METHODS

PAGE = "docs/data.md"
BALL = Ball(0.2, 0.04)
SCENE = {
    "picture": "motion",
    "ball": {"k": 0.2, "g": 0.04},
    "energy": 0.01,
    "period": 1,
    "type": "elliptic",
    "duration": 1.0,
    "axes": {
        "t": {"limits": [0, 1], "ticks": [0, 1]},
        "displacement": {"limits": [-0.5, 0.5], "ticks": [0]},
    },
}


def stages_of(package):
    return {name for name, stage in STAGES.items() if stage.function.startswith(package)}


def needs():
    """The dataset of the errors of one figure."""
    one = symmetric_orbits(BALL, 0.01, 1)
    kinds, inputs = {"fig3": "motion"}, ["periodic/fig3"]
    return figure_errors.figure_errors(one, scenes={"fig3": SCENE}, measures=kinds, inputs=inputs)


STUDY = {
    "work": lambda: stages.with_recorded(
        stages.accuracy(METHODS[:1], 2).assign(stages.missed(METHODS[:1], [0])), "work"
    ),
    "edges": lambda: stages.with_recorded(stages.failures(stages.EDGE_METHODS[:1], 2), "edges"),
    "misses": lambda: stages.misses(1000),
    "drift": lambda: stages.drift(1000),
    "needs": needs,
    "work_all": lambda: measured.timed_work(METHODS[:1], 2, 1),
}


def assert_described(data):
    for name, variable in data.variables.items():
        assert variable.attrs["long_name"], name
        if variable.dtype.kind not in "OUT":
            assert variable.attrs["units"] == "1" and variable.attrs["scale"], name


def assert_describes_itself(file):
    """Its variables do, and the page has what the file says of itself as a whole."""
    with xr.open_dataset(file) as data:
        assert_described(data)
        assert {"title", "config", "source", "references", "k", "g", "energy"} <= set(data.attrs)
        if "row_size" in data:
            dimension = data["row_size"].attrs["sample_dimension"]
            assert data["row_size"].sum() == data.sizes[dimension]
        for attribute in data.attrs:
            assert f"`{attribute}`" in text_of(PAGE), attribute
        return data.attrs["stage"]


def test_datasets_of_the_papers_figures_describe_themselves(finished):
    files = (finished.path / "results" / "paper").glob("*.nc")
    assert {assert_describes_itself(file) for file in files} == stages_of("pseudorigid.")


@pytest.mark.parametrize("name", STUDY)
def test_a_dataset_of_the_study_describes_itself(name, tmp_path):
    artifacts.save(STUDY[name](), tmp_path / "data.nc", {})
    assert assert_describes_itself(tmp_path / "data.nc") == "study"


def test_the_page_has_each_stage():
    """Also those of the extensions of this repository, as far as they are there."""
    assert stages_of("study.") == set(STUDY)
    rows = re.findall(r"^\| (`.*?) \|", text_of(PAGE), re.M)
    named = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    assert len(set(named)) == len(named) and set(STAGES) <= set(named)


@pytest.fixture
def path(tmp_path):
    """A small dataset where the page's examples read it."""
    data = scene_orbits(BALL, 0.01, [0.1, -0.2, 0.6], [30, 20, 25])
    path = tmp_path / "results" / "paper" / "orbits_fig2.nc"
    artifacts.save(data, path, {}, k=0.2, g=0.04, energy=0.01, title="orbits")
    return path


def test_the_examples_in_python_run(path, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks(PAGE):
        if not block.startswith("ncdump"):
            exec(block, names)
    printed = capsys.readouterr().out
    assert "xdot:scale = omega R ;" in printed and "time of flight" in printed
    assert ":references = E. Kanso and P. Papadopoulos" in printed
    data = artifacts.load(path)
    assert np.array_equal(names["second"]["x"], data["x"][30:50])
    means = names["table"].groupby("orbit")["tau"].mean()
    assert np.allclose(means, [part.mean() for part in np.split(data["tau"].values, [30, 50])])
    start = BALL.start(-0.2, 0.01)
    assert np.array_equal(names["more"]["x"][:, 1], orbit(BALL, start, 120)["x"][20:])


def test_xarray_and_the_project_read_the_same(path):
    with xr.open_dataset(path) as data:
        assert data.load().identical(artifacts.load(path))


def test_datasets_of_the_python_api_have_the_same_attributes():
    six = symmetric_orbits(BALL, 0.01, 6)
    start = BALL.start([0.5], 0.01)
    orbits = orbit(BALL, start, 3)
    branch = trace_manifold(BALL, 0.01, six.isel(orbit=1), length=0.1)
    for data in (orbits, six, branch, lyapunov_spectrum(BALL, start, 3)):
        assert_described(data)
    scales = {name: orbits[name].attrs["scale"] for name in ("x", "xdot", "udot", "tau")}
    assert scales == {"x": "R", "xdot": "omega R", "udot": "omega", "tau": "1/omega"}
