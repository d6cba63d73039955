"""Runs of variants: shared results, figures that cannot exist, and a copy scaled by two."""

import numpy as np
import pytest

from helpers.project import make_here, of_scenes
from helpers.runs import VARIANTS, contents, rows
from pipeline import config
from pipeline.declaration import parts
from pipeline.records.artifacts import load

LENGTHS = {"x", "xdot", "udot", "position", "strain", "impact_position"}
ABSENT = "cannot exist: no elliptic orbit of period 6 at energy 0.0017"


@pytest.fixture
def done(variants, tmp_path):
    return variants.copy(tmp_path / "done")


def edit(tree, name, block):
    document = tree.document()
    document["variants"][name] = block
    tree.write(document)


def figures_of(tree, name):
    return {path.name for path in (tree.path / "results" / name / "figures").iterdir()}


@pytest.fixture(scope="module")
def scaled(tmp_path_factory):
    """Return a function of a variant and a name that computes the dataset of a small scene."""
    folder = tmp_path_factory.mktemp("scaled")
    document = of_scenes("fig4", "fig5", "fig7", variants=VARIANTS)
    specs = config.check(document).build_specs()

    def data(variant, name):
        path = f"results/{variant}/{name}.nc"
        make_here(folder, specs, [path])
        return load(folder / path)

    return data


@pytest.mark.parametrize(
    "name", ["orbits_fig5", "periodic_fig4", "motion_fig4", "manifolds_fig5", "lyapunov_fig7"]
)
def test_the_copy_scaled_by_two_is_equal_in_every_bit(scaled, name):
    paper, doubled = (scaled(variant, name) for variant in ("paper", "doubled"))
    assert doubled.attrs["g"] == 2.0 * paper.attrs["g"]
    assert doubled.attrs["energy"] == 4.0 * paper.attrs["energy"]
    assert set(paper.variables) == set(doubled.variables)
    for key, variable in paper.variables.items():
        ours = doubled.variables[key].values
        scaled = variable.values * 2.0 if key in LENGTHS else variable.values
        assert ours.dtype == scaled.dtype and ours.shape == scaled.shape
        if ours.dtype.kind == "O":
            assert ours.tolist() == scaled.tolist()
        else:
            assert ours.tobytes() == scaled.tobytes(), key
    lengths = {"window_x", "window_xdot", "point_x", "point_xdot"}
    for key in set(paper.attrs) - {"g", "energy", "config"}:
        value = np.asarray(paper.attrs[key])
        assert np.array_equal(doubled.attrs[key], value * 2.0 if key in lengths else value), key


@pytest.mark.slow
def test_a_figure_that_cannot_exist_is_named_and_the_rest_is_drawn(variants):
    assert figures_of(variants, "low") == {"fig3.png", "fig7.png"}
    if "publication" not in parts():
        pytest.skip("two variants are compared by the part publication")
    output = (variants.path / "said of paper and low").read_text()
    named = [line.split()[0] for line in output.splitlines() if ABSENT in line]
    assert named[0].startswith("results/low/figures/fig4.") and named[1:] == ["low:"]
    assert {*rows(output).values()} == {"published again"}  # what is current is not listed


@pytest.mark.slow
def test_a_variant_s_figures_are_not_published(variants):
    assert set(contents(variants)) == {"fig3.png", "fig4.png", "fig7.png"}
    data = (variants.path / "results" / "paper" / "figures" / "fig7.png").read_bytes()
    assert contents(variants)["fig7.png"] == data


@pytest.mark.slow
def test_what_is_shared_is_not_computed_again_and_what_cannot_exist_is_removed(done):
    """A variant gets the energy of the paper back, and a scene without an orbit."""
    folder = done.path / "results"
    edit(done, "low", {"scenes": {"fig3": {"period": 5}, "fig7": {"impacts": 50}}})
    before = {path: path.stat().st_ino for path in folder.glob("paper/*.nc")}
    result = done.run("variant", "low")
    assert result.returncode == 0, result.stdout
    assert "cannot exist: no elliptic orbit of period 5" in result.stdout
    assert figures_of(done, "low") == {"fig4.png", "fig7.png"}
    assert {path: path.stat().st_ino for path in before} == before  # files are replaced as a whole
    assert not (folder / "low" / "motion_fig4.nc").exists()
    drawn, paper = (folder / name / "figures/fig4.png" for name in ("low", "paper"))
    assert drawn.read_bytes() == paper.read_bytes()
