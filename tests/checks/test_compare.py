"""./reproduce compare: config, norms, periodic orbits, exponents, and the picture."""

import numpy as np
import pytest
import xarray as xr

from pipeline.checks.compare import cycles, exponents, norms
from pipeline.checks.compare import orbits as apart
from pipeline.records.pictures import pixels
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.orbits import scene_orbits

NAMES = ("one", "two")
NAMED = "paper, low, doubled"  # what can be compared


def dataset(**values):
    return xr.Dataset({name: (f"{name}_i", np.asarray(v)) for name, v in values.items()})


def test_the_norms_are_those_of_the_definition():
    a, b = np.array([3.0, 4.0]), np.array([3.0, 4.5])
    lines = norms.table(dataset(x=a, same=a), dataset(x=b, same=a), NAMES)
    assert len(lines) == 2
    name, count, first, second, relative, largest = lines[1].split()
    assert (name, count) == ("x", "2")
    assert float(first) == pytest.approx(np.sqrt(12.5), rel=1e-5)
    assert float(second) == pytest.approx(np.sqrt((9 + 20.25) / 2), rel=1e-5)
    assert (float(relative), float(largest)) == (0.1, 0.5)


def test_other_shapes_gaps_and_lonely_variables_are_said():
    a, b = dataset(x=[1.0, 2.0]), dataset(x=[1.0, 2.0, 3.0], y=[1.0])
    lines = norms.table(a, b, NAMES)
    assert lines[0].split()[:2] == ["variable", "values"]
    assert lines[1].split()[:4] == ["x", "2", "|", "3"]
    assert "in two only" in lines[2]
    gap = norms.table(dataset(x=[1.0, np.nan]), dataset(x=[2.0, np.nan]), NAMES)
    assert gap[1].split()[-2:] == ["1", "1"]
    assert norms.table(a, a, NAMES) == ["the same data"]


def test_a_summary_is_one_line_that_names_the_variable_that_differs_most():
    a = dataset(x=[3.0, 4.0], y=[1.0], n=[1], z=[1.0, 2.0], same=[5.0])
    b = dataset(x=[3.0, 4.5], y=[1.01], n=[9], z=[1.0], same=[5.0])
    line = "4 of 5 variables differ, x the most: by 0.1 of its norm; "
    line += "1 of other lengths or in one only"
    assert norms.summary(a, b, NAMES) == line
    assert norms.summary(a, a, NAMES) == "the same data"


def test_of_orbits_the_first_impact_that_is_apart_is_told():
    ball = Ball(k=0.2, g=0.04)
    near = [scene_orbits(ball, 0.01, [0.3], [100]) for _ in range(2)]
    for data in near:
        data.attrs |= {"k": 0.2, "g": 0.04, "energy": 0.01}
    assert apart.summary(*near) == ["all 1 orbits stay within 0 section radii"]
    near[1]["x"][41] += 0.1
    line = "1 of 1 orbits are apart by more than 0.001 section radii, the first from impact 42 on"
    assert apart.summary(*near) == [line]


def test_nothing_and_zero_have_norms():
    lines = norms.table(dataset(x=[0.0]), dataset(x=[2.0]), NAMES)
    assert lines[1].split() == ["x", "1", "0", "2", "-", "2"]


def orbits(energy, k=0.2, g=0.04, period=6):
    return symmetric_orbits(Ball(k=k, g=g), energy, period)


def test_orbits_of_a_little_more_energy_are_kept():
    pairs, lost, gained = cycles.match(orbits(0.01), orbits(0.0101))
    assert [(i, j) for i, j, _ in pairs] == [(0, 0), (1, 1), (2, 2)]
    assert all(0.0 < distance < 0.02 for _, _, distance in pairs)
    assert lost == gained == []


def test_a_scaled_copy_has_the_same_orbits_in_the_same_places():
    pairs, _, _ = cycles.match(orbits(0.01), orbits(0.04, g=0.08))
    assert [distance for _, _, distance in pairs] == [0.0, 0.0, 0.0]


def test_orbits_are_lost_gained_and_changed():
    there, none = orbits(0.01), orbits(0.001)
    assert cycles.match(there, none) == ([], [0, 1, 2], [])
    assert cycles.match(none, there) == ([], [], [0, 1, 2])
    lines = cycles.table(there, none, NAMES)
    assert lines[0] == "period 6: lost: elliptic (rotation 0.1794)"
    other = there.copy()
    other["type"] = ("orbit", np.array(["inverse hyperbolic", "hyperbolic", "elliptic"], object))
    assert cycles.table(there, other, NAMES)[0].startswith("period 6: changed in type: elliptic")
    assert cycles.table(none, none, NAMES) == ["period 6: none in either"]


def test_other_periods_are_listed_and_not_matched():
    lines = cycles.table(orbits(0.01, period=1), orbits(0.01), NAMES)
    assert lines[0] == "one: period 1: elliptic (rotation 0.179)"
    assert lines[1].startswith("two: period 6: elliptic")


def test_the_spread_is_the_standard_deviation_between_orbits():
    assert exponents.spread(np.array([0.1, 0.3])) == "0.2000 ± 0.1414 (0.1000 to 0.3000)"
    assert exponents.spread(np.array([-1e-9])) == "0.0000"


def test_what_is_missing_is_made_and_everything_is_said(variants):
    said = (variants.path / "said of paper and low").read_text().partition("\npaper | low\n")[2]
    assert "  energy: 0.01 | 0.0017\n" in said
    assert "  cannot exist in low: no elliptic orbit of period 6 at energy 0.0017" in said
    assert "  motion      5 of 5 variables differ; 5 of other lengths" in said
    assert "    period 1: kept: elliptic (rotation 0.179) | elliptic (rotation 0.1281)" in said
    assert "    period 6: lost: elliptic (rotation 0.1794)" in said
    assert "  impacts   3 of 60 " in said
    assert "lambda 1" in said


def test_both_figures_are_side_by_side(variants):
    results = variants.path / "results"
    for name in ("fig3", "fig7"):
        both = pixels(results / "compare" / "paper..low" / f"{name}.png")
        parts = [
            pixels(results / variant / "figures" / f"{name}.png") for variant in ("paper", "low")
        ]
        high, wide, _ = parts[0].shape
        assert both.shape == (high + 75, 2 * wide, 3)
        assert np.array_equal(both[75:, :wide], parts[0])
        assert np.array_equal(both[75:, wide:], parts[1])
        assert (both[:75, :wide] < 128).any()
    one = pixels(results / "compare" / "paper..low" / "fig4.png")
    drawn = pixels(results / "paper" / "figures" / "fig4.png")
    assert np.array_equal(one[75:, : drawn.shape[1]], drawn)


@pytest.mark.slow
def test_a_damaged_artifact_is_made_again_first(variants, tmp_path):
    tree = variants.copy(tmp_path / "damaged")
    artifact = tree.path / "results" / "low" / "lyapunov_fig7.nc"
    whole = artifact.read_bytes()
    artifact.write_bytes(whole[:3000])
    result = tree.run("compare", "paper", "low")
    assert result.returncode == 0
    assert "results/low/lyapunov_fig7.nc: changed after it was made: made again" in result.stdout
    assert artifact.read_bytes() == whole


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ((), f"reproduce: compare needs two names of {NAMED}"),
        (("low",), f"reproduce: compare needs two names of {NAMED}"),
        (("low", "low"), f"reproduce: compare needs two names of {NAMED}"),
        (
            ("low", "lo"),
            f"reproduce: no variant lo: did you mean low? config.yaml has {NAMED}",
        ),
        (("low", "-n"), f"reproduce: compare needs two names of {NAMED}"),
    ],
)
def test_bad_names_are_one_line(variants, words, line):
    result = variants.run("compare", *words)
    assert (result.returncode, result.stdout) == (2, line + "\n")
