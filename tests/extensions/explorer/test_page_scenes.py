"""Scenes are opened as Python has them; scenes, tables and pictures that are saved are right."""

import csv
import io
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

from extensions.explorer import data
from helpers.parts.engine import PROJECTED
from helpers.project import SHIPPED, shipped
from pipeline import config
from pipeline.config.validation.document import check
from pseudorigid import Ball, symmetric_orbits

BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01


@pytest.fixture(scope="module")
def scenes():
    return data.collect(config.load(SHIPPED))["scenes"]


def test_each_scene_is_a_state_that_its_address_keeps(scripts, scenes):
    script = """return Object.keys(args[0]).map((name) => {
      const state = presetState(name, args[0]);
      return [name, state, readAddress(writeAddress(state), args[0])]; })"""
    for name, state, found in scripts.run(script, scenes):
        scene = scenes[name]
        found.pop("leftOut", None)
        assert [state[key] for key in ("k", "g", "energy")] == [
            scene["ball"]["k"], scene["ball"]["g"], scene["energy"],
        ]  # fmt: skip
        for before, after in zip(state.pop("orbits"), found.pop("orbits"), strict=True):
            place = [before.pop("p"), before.pop("q")]
            assert [after.pop("p"), after.pop("q")] == pytest.approx(place, abs=1e-15)
            assert before == after and np.hypot(*place) < 1
        assert found == state, name


def test_orbits_of_a_scene_start_where_python_starts_them(scripts, scenes):
    script = """const shown = ([, { picture }]) => args[1].includes(picture);
      return Object.entries(args[0]).filter(shown).map(([name, scene]) => {
      const { ball: { k, g }, energy } = scene;
      return [name, presetState(name, args[0]).orbits.map((orbit) =>
        [geometry.stateAt(k, g, energy, orbit), orbit.impacts])]; })"""
    kinds = ["portrait", "tangle", "jumps", "curves", "graph", "exclusion", "exponents"]
    rows = scripts.run(script, scenes, kinds)
    assert len(rows) > 8
    for name, orbits in rows:
        scene = scenes[name]
        ball = Ball.unbounded(**scene["ball"])
        for (state, impacts), start, i in zip(orbits, scene["starts"], range(64), strict=False):
            wanted = scene["impacts"]
            assert impacts == (wanted[i] if isinstance(wanted, list) else wanted)
            if isinstance(start, float | int):
                assert state == [*map(float, ball.start(start, scene["energy"]))]
            else:
                assert state[0] == pytest.approx(start["x"])
                y = state[1] - ball.k * state[2]
                shown = y if "y" in start else state[1]
                assert shown == pytest.approx(start.get("y", start.get("xdot")))


def test_rows_of_starts_and_points_of_the_section(scripts):
    row = scripts.run("return fan(-0.46, -0.03, 44, 7)")
    assert [one["p"] for one in row] == pytest.approx(np.linspace(-0.46, -0.03, 44), abs=1e-12)
    assert {one["impacts"] for one in row} == {7}
    assert scripts.run("return fan(0.6, 0.7, 1, 7)[0].p") == 0.6
    scene = {"ball": {"k": 0.2, "g": 0.04}, "energy": ENERGY}
    x, xdot, udot = map(float, BALL.state_xy(0.1, 0.03, ENERGY))
    for start in ({"x": x, "y": 0.03}, {"x": x, "xdot": xdot}):
        point = scripts.run("return pointOf(...args)", start, scene)
        assert point == pytest.approx([x, xdot - BALL.k * udot])
    half = {"axes": {"x": {"limits": [0.21, 0.2116]}, "xdot": {"limits": [0.0925, 0.0932]}}}
    view = scripts.run("return closeUp(args[0]).view", {**scene, **half, "length": 1})
    window = scripts.run(PROJECTED, {"view": view, **scene["ball"], "energy": ENERGY}, [])[0]
    centre, radius = BALL.section(ENERGY)
    assert window["p"][0] < (0.21 - centre) / radius < (0.2116 - centre) / radius < window["p"][1]


def block_of(scripts, kind, state, orbits, periodic=()):
    """The scene of a kind, as config.yaml reads what the page copies."""
    script = """const [kind, given, orbits, found] = args;
      const state = { ...freshState(), ...given };
      const section = Object.create(SectionView.prototype);
      Object.assign(section, { width: 500, height: 420, read: () => ({ state }) });
      section.project();
      return sceneBlock(kind, { state, orbits, periodic: new Map(found), section })"""
    copied = scripts.run(script, kind, state, orbits, [*periodic])
    assert max(map(len, copied["text"].splitlines())) <= 100
    document = shipped() | {"scenes": yaml.safe_load(copied["text"]), "variants": {}}
    check(document, main_alone=True)  # refuses what no run could draw
    ((name, block),) = document["scenes"].items()
    assert name == copied["name"] and block["picture"] == kind
    return block, copied["note"]


def test_a_copied_scene_is_the_one_on_the_page(scripts, scenes):
    state = scripts.run("return presetState('fig2', args[0])", scenes)
    block, note = block_of(scripts, "portrait", state, state["orbits"])
    for field in ("energy", "starts", "impacts", "view"):
        assert block[field] == scenes["fig2"][field]
    assert block["ball"] == {"k": 0.2, "g": 0.04} and note == ""
    backward = [*state["orbits"], {**state["orbits"][0], "back": True}]
    block, note = block_of(
        scripts, "portrait", {**state, "view": {**state["view"], "half": 0.1}}, backward
    )
    assert len(block["starts"]) == 8 and "left out" in note and "whole half ellipsoid" in note


def test_copied_numbers_have_all_their_bits(scripts):
    values = [1e-7, -2.5e-10, 1e21, 0.1 + 0.2, 1 / 3, -0.0004, 5e-324, 12.0]
    assert [
        yaml.safe_load(text) for text in scripts.run("return args.map(yamlNumber)", *values)
    ] == values
    random = np.random.default_rng(4)
    xy = [[float(x), float(y)] for x, y in random.uniform(-0.05, 0.05, (60, 2))]
    orbits = [{"p": 0, "q": 0.1, "xy": at, "impacts": 5, "back": False} for at in xy]
    orbits += [{"p": 0.25, "q": -0.125, "xy": None, "impacts": 6, "back": False}]
    block, _ = block_of(
        scripts, "jumps", {"k": 0.2, "g": 0.04, "energy": ENERGY, "jump": True}, orbits
    )
    assert [[start["x"], start["y"]] for start in block["starts"][:60]] == xy
    centre, radius = BALL.section(ENERGY)
    point = centre + 0.25 * radius, -0.125 * radius * np.sqrt(0.24)
    assert [*block["starts"][60].values()] == pytest.approx(point)
    assert block["energies"][0] == pytest.approx(1.25 * 0.04**2 * 1.1, rel=1e-2)


def test_a_copied_saddle_has_its_branches_and_a_close_up_its_window(scripts):
    found = symmetric_orbits(BALL, ENERGY, 6)
    orbits = [
        {"type": str(one["type"].item()), "points": np.stack(
            [one[name] for name in ("x", "xdot", "udot")], axis=1).tolist()}
        for one in (found.isel(orbit=i) for i in range(found.sizes["orbit"]))
    ]  # fmt: skip
    branch = {"period": 6, "type": "hyperbolic", "nth": 0, "saddle": -1, "kind": "both"}
    branches = [
        {**branch, "side": "inner", "length": 1.5},
        {**branch, "side": "both", "length": 0.5},
    ]
    start = {"p": 0.2, "q": 0, "xy": None, "impacts": 9, "back": False}
    state = {"k": 0.2, "g": 0.04, "energy": ENERGY, "branches": branches}
    block, note = block_of(scripts, "tangle", state, [start])
    assert block["branches"] == {"outer": {"length": 0.5}, "inner": {"length": 1.5}} and note == ""
    saddle = next(one["points"] for one in orbits if one["type"] == "hyperbolic")
    centre, radius = BALL.section(ENERGY)
    nearest = 2
    x, xdot, udot = saddle[nearest]
    middle = (x - centre) / radius, (xdot - BALL.k * udot) / radius / np.sqrt(0.24)
    view = {
        "kind": "disk",
        "azimuth": 115,
        "elevation": 40,
        "x": middle[0],
        "y": middle[1],
        "half": 0.01,
    }
    block, note = block_of(scripts, "closeup", {**state, "view": view}, [], [[6, orbits]])
    assert block["point"] == nearest and block["length"] == 1.5
    assert all(low < 0 < high for low, high in block["window"].values())
    assert block["window"]["x"] == pytest.approx([-0.01, 0.01], rel=1e-3)
    kinds = "return sceneKinds({ ...freshState(), ...args[0] }, args[1])"
    assert scripts.run(kinds, {**state, "view": view}, [start])[:2] == ["closeup", "tangle"]
    assert scripts.run(kinds, {}, [{**start, "back": True}]) == []
    motion = {"motion": {"period": 6, "type": "elliptic", "nth": 0}, "span": 30}
    assert scripts.run(kinds, motion, []) == ["motion"]
    block, _ = block_of(scripts, "motion", {**state, **motion}, [])
    assert (block["period"], block["type"], block["duration"]) == (6, "elliptic", 30)


def test_a_table_has_the_impacts_of_each_orbit_from_its_start(scripts):
    script = """const piece = (n) => ({ x: [n], xdot: [0.1], udot: [1 / 3], tau: [1e-7] });
      const orbits = [false, true].map((back) => ({ back, start: [0.5, 0.25, 0.125] }));
      const state = { k: 0.2, g: 0.04, energy: 0.01 };
      const page = { orbits, data: { version: "1.2" }, state, save() {},
        async eachPiece(orbit, from, act) { act(piece(1), 0); act(piece(2), 1); } };
      return (await orbitsCsv(page, orbits)).text"""
    lines = scripts.run(script).splitlines()
    assert lines[:3] == ["# 1.2", "# k = 0.2, g = 0.04, E = 0.01", "# explorer.html#k=0.2"]
    rows = [*csv.DictReader(io.StringIO("\n".join(lines[3:])))]
    assert [(row["orbit"], row["impact"]) for row in rows] == [
        ("1", "0"), ("1", "1"), ("1", "2"), ("2", "0"), ("2", "-1"), ("2", "-2"),
    ]  # fmt: skip
    assert (rows[0]["x"], rows[0]["tau"]) == ("0.5", "") and rows[4]["x"] == "1"
    assert float(rows[1]["udot"]) == 1 / 3 and float(rows[1]["tau"]) == 1e-7


def test_a_picture_as_svg_has_what_was_drawn(scripts):
    script = """const pen = new SvgPen();
      Object.assign(pen, { fillStyle: "#123456", strokeStyle: "#654321", font: "12px sans" });
      pen.save(); pen.beginPath(); pen.rect(1, 2, 3, 4); pen.clip();
      pen.beginPath(); pen.arc(10, 20, 5, 0, 7); pen.fill();
      pen.restore();
      pen.setLineDash([5, 4]);
      pen.beginPath(); pen.moveTo(0, 0.125); pen.lineTo(7, 8); pen.stroke();
      pen.dots([1, 2, 3, 4], 1.5, "red");
      pen.textAlign = "right"; pen.textBaseline = "middle"; pen.fillText("a < b & c", 30, 40);
      return pen.file(100, 50, "k < 1")"""
    root = ElementTree.fromstring(scripts.run(script))
    space = "{http://www.w3.org/2000/svg}"
    meta, clip, group, line, dots, text = root
    assert (root.get("viewBox"), meta.text) == ("0 0 100 50", "k < 1")
    assert group.get("clip-path") == f"url(#{clip.get('id')})"
    assert clip[0].get("d") == "M1 2h3v4h-3z"
    assert group[0].get("d") == "M5 20a5 5 0 1 1 10 0a5 5 0 1 1 -10 0z"
    assert (line.get("d"), line.get("stroke-dasharray")) == ("M0 0.13L7 8", "5 4")
    assert dots.get("d") == "M1 2h0M3 4h0" and dots.get("stroke-width") == "1.5"
    assert (text.text, text.get("text-anchor"), text.tag) == ("a < b & c", "end", f"{space}text")
    assert float(text.get("y")) == pytest.approx(40 + 0.35 * 12)
