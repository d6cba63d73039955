"""Scenes of chains over a sweep: what is refused, and a run."""

import pytest
from documents import complaint, good
from project import fresh_tree, of_scenes

PLANE = {"k": [0.19, 0.21], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}
CHAINS = {"picture": "chains", "over": "a", "chains": [6]}


@pytest.mark.parametrize(
    ("plane", "chains", "start", "allowed"),
    [
        ({}, {"chains": [5, 5]}, "chains: [5, 5]", "none of them twice"),
        ({}, {"over": "b"}, "over: 'b'", "a scene of kind atlas"),
        ({"k": [0.2]}, {}, "over: 'a'", "several k"),
        ({"energy": [-0.1, 1]}, {}, "over: 'a'", "above 0"),
    ],
)
def test_chains_that_cannot_be_are_refused_in_one_line(plane, chains, start, allowed):
    line = complaint(good() | {"sweeps": {"a": PLANE | plane, "over_it": CHAINS | chains}})
    assert line.startswith(f"sweeps.over_it.{start}") and allowed in line


@pytest.mark.slow
def test_chains_are_drawn_over_the_data_of_the_sweep(tmp_path):
    sweeps = {"a": PLANE, "over_it": CHAINS}
    tree = fresh_tree(tmp_path / "a fresh clone", of_scenes("fig3", sweeps=sweeps))
    tree.succeed("atlas", "-c", "1")
    assert {file.name for file in (tree.path / "results/atlas").glob("*_a.nc")} == {"sweep_a.nc"}
    assert (tree.path / "results/atlas/chains_over_it.nc").is_file()
    assert (tree.path / "more_figures/atlas/over_it.png").read_bytes().startswith(b"\x89PNG")
