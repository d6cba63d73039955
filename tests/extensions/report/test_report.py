"""The report and docs/figures.md: every figure, its caption and what was measured in it."""

import json
import shutil
from html import unescape

import pytest
from report_pages import (
    PAGE,
    rendered,
)

from paper.numbers import PAPER_NUMBERS
from pipeline import config
from pipeline.checks import captions, quantities
from pipeline.config.schema.kinds import KINDS
from pipeline.records.artifacts import load
from pipeline.records.record import record_path, refusal_path


@pytest.fixture(scope="module")
def text(reported):
    return (reported.path / PAGE).read_text(encoding="utf-8")


def test_each_figure_has_its_caption_and_numbers(reported, text):
    checked = config.load(reported.config)
    for scene, block in checked.scenes.items():
        known = None
        if scene in ("fig3", "fig6", "fig7"):  # those that were made
            known = quantities.measured(
                reported.path, checked, config.MAIN, scene, quantities.facts
            )
            assert captions.caption_of(scene, block.as_mapping(), known).see in unescape(text)
    assert "<td>approximately 0.235</td><td>0." in text
    assert "<td>between 0.0925 and 0.0932</td><td>0.09" in text
    assert "<td>0.21 to 0.2116</td><td>0.21 to 0.2116</td>" in text
    assert "orbit: elliptic, period 1 (at the paper" in text  # of the variant


def test_what_is_missing_or_damaged_is_not_shown(reported, tmp_path):
    tree = reported.copy(tmp_path / "poor")
    shutil.rmtree(tree.path / "results" / "low")
    with open(tree.path / "results" / "paper" / "lyapunov_fig7.nc", "r+b") as file:
        file.truncate(1000)
    fig6 = "results/paper/figures/fig6.png"
    (tree.path / fig6).unlink()
    refusal = json.loads((tree.path / record_path(fig6)).read_text())
    refusal["output"] = {"sha256": None, "refused": "no hyperbolic orbit"}
    (tree.path / refusal_path(fig6)).write_text(json.dumps(refusal))
    text = rendered(tree)
    assert "Not computed yet: low" in text and '<h2 id="variants"' not in text
    assert "<p>No picture: stale: changed after it was made; made from another results/" in text
    assert "<td>approximately 0.235" not in text
    assert "<p>No picture: cannot exist: no hyperbolic orbit.</p>" in text
    assert 'alt="Figure 6' not in text


@pytest.fixture(scope="module")
def scenes(finished):
    """Scene -> its block and its datasets."""
    checked = config.load(finished.config)
    files = {scene: checked.data_of("paper", scene).items() for scene in checked.scenes}
    return {
        scene: (block.as_mapping(), {s: load(finished.path / f) for s, f in files[scene]})
        for scene, block in checked.scenes.items()
    }


def test_quantities_are_measured_in_the_data_and_not_read_from_the_config(scenes):
    for scene, (block, data) in scenes.items():
        kind = KINDS[block["picture"]]
        values = quantities.reported(block, data)
        assert kind.headline in values
        assert set(PAPER_NUMBERS[scene]) <= set(values)
        other = block | {"energy": 0.5, "impacts": 3, "starts": [0.1], "duration": 1.0}
        other |= {"window": {"x": [0, 1], "xdot": [0, 1]}, "length": 9, "period": 99}
        assert quantities.reported(other, data) == values


def test_other_data_give_other_numbers(scenes):
    def measured(scene, **changes):
        block, data = scenes[scene]
        other = data | {stage: change(data[stage]) for stage, change in changes.items()}
        return quantities.reported(block, other)

    shifted = measured("fig6", manifolds=lambda d: d.assign_attrs(point_x=0.3, window_x=[0.2, 0.4]))
    assert shifted["x of the point"] == "0.3000000" and shifted["window, x"] == "0.2 to 0.4"
    faster = measured("fig2", orbits=lambda d: d.assign(xdot=d["xdot"] * 1.1))
    assert faster["energy"] != measured("fig2")["energy"] == "0.01"
    larger = measured("fig7", lyapunov=lambda d: d.assign(exponent=d["exponent"] + 1.0))
    assert all(float(value) > 1.0 for value in larger["largest exponent"].split(", "))
