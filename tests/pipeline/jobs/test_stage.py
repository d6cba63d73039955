"""What the jobs hand to the function of a stage or a picture, and what they save of it."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

from pipeline.jobs import draw, stage
from pipeline.records.artifacts import load, save
from pipeline.records.provenance import BuildSpec

BLOCK = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "count": 3}
RESULT = "results/paper/a.nc"


@pytest.fixture
def computed(tmp_path, monkeypatch):
    """Return a function: (block, function of a stage) -> the saved dataset; it fills `called`."""
    monkeypatch.chdir(tmp_path)

    def run(block, function, **known):
        function.__doc__ = "Compute a little."
        monkeypatch.setattr(stage, "imported", lambda name: function)
        spec = BuildSpec(RESULT, "fig", "orbits", block, "stage", "f", {}, ["input.nc"])
        assert stage.make(spec, **known) is None
        return load(RESULT)

    values = xr.Dataset(
        {"x": ("point", np.ones(2), {"long_name": "x", "units": "1", "scale": "R"})}
    )
    save(values, "input.nc", {}, stage="a")
    return run


def test_a_stage_gets_ball_energy_inputs_and_fields_and_its_dataset_says_so(computed, tmp_path):
    called = {}

    def function(ball, energy, data, count, folder, level):
        called.update(ball=(ball.k, ball.g), energy=energy, count=count, folder=folder, level=level)
        return data

    attrs = computed(BLOCK, function, level=2).attrs
    folder = f"{RESULT}.part"
    expected = {"ball": (0.2, 0.04), "energy": 0.01, "count": 3, "folder": folder, "level": 2}
    assert called == expected
    assert (attrs["k"], attrs["g"], attrs["energy"], attrs["stage"]) == (0.2, 0.04, 0.01, "orbits")


@pytest.mark.parametrize("energy", [{}, {"energy": [0.01, 0.02]}])
def test_a_stage_without_a_ball_gets_an_energy_if_the_scene_has_one(computed, energy):
    called = {}

    def function(data, count, **others):
        called.update(count=count, **others)
        return xr.Dataset(data.variables, attrs={"title": "of its own"})

    attrs = computed({"count": 4} | energy, function).attrs
    assert called == {"count": 4} | energy and attrs["title"] == "of its own" and "k" not in attrs


def test_progress_is_printed_every_four_seconds_at_most(computed, monkeypatch, capsys):
    now = [100.0]
    monkeypatch.setattr(stage.time, "monotonic", lambda: now[0])

    def function(ball, energy, data, count, progress):
        for share in (0.0, 0.25, 0.5, 0.75):
            progress(share, "halving")
            now[0] += 2.1
        return data

    computed(BLOCK, function)
    assert capsys.readouterr().err == "fig: 0%, halving\nfig: 50%, halving\n"


def test_a_picture_is_drawn_in_its_format_and_says_what_axes_hide(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    figure = plt.Figure((1, 1))
    monkeypatch.setattr(draw, "imported", lambda name: lambda block: figure)
    monkeypatch.setattr(draw, "hidden_by", lambda name, block: [f"{name} hides {block['picture']}"])
    for suffix, start in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        result = f"results/paper/figures/fig.{suffix}"
        spec = BuildSpec(result, "fig", "drawing", {"picture": "a_b"}, "draw", "f", {}, [])
        assert draw.make(spec) == {"hidden": ["f hides a_b"]}
        assert (tmp_path / result).read_bytes().startswith(start)
    assert figure.get_label() == "fig: a b"
