"""Scenes with a `method`: their data count what it missed, and nothing else changes."""

import pytest

from helpers.project import make_here, of_scenes
from pipeline import config
from pipeline.jobs import stage
from pipeline.records.artifacts import load

DOCUMENT = of_scenes("fig2", "fig3", "fig7")
for scene, given in {
    "fig2": {"method": {"scan": 0.1, "tolerance": 1e-12}},
    "fig3": {"method": {"scan": 0.1, "tolerance": 1e-12}},
    "fig7": {"method": {"scan": 1, "tolerance": 1e-3}, "impacts": 3000},
}.items():
    DOCUMENT["scenes"][scene] |= given
CHECKED = config.check(DOCUMENT)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Orbits, a motion and exponents of small scenes by scan and bisection."""
    folder = tmp_path_factory.mktemp("by the paper's method")
    names = ("orbits_fig2", "motion_fig3", "lyapunov_fig7")
    make_here(folder, CHECKED.build_specs(), [f"results/paper/{name}.nc" for name in names])
    return folder


def attributes(folder, name):
    return load(folder / "results" / "paper" / f"{name}.nc").attrs


def test_the_data_of_a_method_say_what_it_missed(made):
    for name in ("motion_fig3", "orbits_fig2", "lyapunov_fig7"):
        attrs = attributes(made, name)
        assert '"method":{"scan":' in attrs["config"]
        assert 0 <= attrs["impacts_missed"] < attrs["impacts"]
    assert attributes(made, "lyapunov_fig7")["impacts"] == 9000
    assert attributes(made, "lyapunov_fig7")["impacts_missed"] > 0


def test_periodic_points_are_those_of_the_certified_map(made):
    attrs = attributes(made, "periodic_fig3")
    assert not {"impacts", "impacts_missed"} & set(attrs) and "method" not in attrs["config"]


def test_missed_impacts_are_noted_in_the_record(made, monkeypatch):
    monkeypatch.chdir(made)
    noted = stage.make(CHECKED.build_specs()["results/paper/lyapunov_fig7.nc"])
    missed = attributes(made, "lyapunov_fig7")["impacts_missed"]
    words = f"{missed} of 9,000 impacts fell through the floor (scan 1, tolerance 0.001)"
    assert noted == {"notes": [words]}
