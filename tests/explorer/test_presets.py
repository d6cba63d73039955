"""Copy as a scene: the block for config.yaml has the picture of the page, to the last bit."""

import numpy as np
import pytest
import yaml
from project import fresh_tree, shipped

from pipeline import config
from pipeline.records.artifacts import load
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits

STATE = ("x", "xdot", "udot")


def copied(person, kind):
    """Copy what is on the page as a scene of a kind, and return its name and its block."""
    person.unfold("record-panel")
    person.choose("scene-kind", kind)
    person.press("copy-scene")
    person.wait(lambda: "config.yaml" in person.text("scene-note"))
    text = person.run("return document.getElementById('scene').value")
    ((name, block),) = yaml.safe_load(text).items()
    assert block["picture"] == kind
    assert max(map(len, text.splitlines())) <= 100
    return name, block


def test_orbits_of_two_clicks_are_copied(person, tmp_path):
    person.open(f"{person.file}#view=disk,115,40,0,0,1.12&next=300")
    person.click(0.4, 0.3)
    person.click(-0.2)
    assert len(person.settled()) == 2
    name, block = copied(person, "portrait")
    document = shipped() | {"scenes": {name: block}, "variants": {}}
    (tmp_path / "config.yaml").write_text(yaml.safe_dump(document))
    block = config.load(tmp_path / "config.yaml")["variants"]["paper"][name]
    orbits = scene_orbits(Ball(**block["ball"]), block["energy"], block["starts"], block["impacts"])
    for variable, values in person.every_point().items():
        assert np.array_equal(orbits[variable].values, values)


@pytest.mark.slow  # it draws eight figures
def test_explored_pictures_are_drawn_by_the_pipeline_with_the_same_points(person, tmp_path):
    scenes, orbits = {}, {}

    def copy(kind):
        name, scenes[name] = copied(person, kind)
        if kind not in ("motion", "closeup", "exponents"):
            orbits[name] = person.every_point()
        return name

    person.clear_disk()
    person.type("impacts", "900")
    person.click(-0.2)
    person.drag(person.spot(0.1), person.spot(0.7))
    person.settled()
    copy("portrait")
    copy("exponents")
    zoomed(person)
    copy("portrait")
    person.press("home")
    for field, value in (("k", "0.3"), ("g", "0.0251"), ("E", "0.0123456789")):
        person.type(field, value)
    person.settled()
    copy("portrait")
    person.choose("preset", "jumps")
    person.settled()
    copy("jumps")
    person.choose("preset", "fig4")
    person.wait(lambda: "3 symmetric" in person.text("periodic-note"))
    motion = copy("motion")
    person.choose("preset", "fig5")
    person.settled()
    tangle = copy("tangle")
    person.choose("preset", "fig6")
    person.wait(lambda: "24 branches" in person.text("branch-note"))
    copy("closeup")

    assert len(scenes) == 8
    tree = fresh_tree(tmp_path / "a tree", shipped() | {"scenes": scenes, "variants": {}})
    result = tree.run(*[f"results/paper/figures/{name}.png" for name in scenes])
    assert result.returncode == 0, result.stdout
    results = tree.path / "results/paper"
    for name, expected in orbits.items():
        dataset = load(results / f"orbits_{name}.nc")
        for variable, values in expected.items():
            assert np.array_equal(dataset[variable].values, values), (name, variable)

    found = person.run(PERIODIC, values_of(scenes[motion]) | {"period": 6})
    (six,) = (one["points"] for one in found if one["type"] == "elliptic")
    times = np.cumsum(np.tile(np.array(six)[:, 3], 9))
    expected = load(results / f"motion_{motion}.nc")["impact_t"].values
    assert np.allclose(times[: expected.size - 1], expected[1:], rtol=0.0, atol=1e-9)

    (saddle,) = (one["points"] for one in found if one["type"] == "hyperbolic")
    branches = load(results / f"manifolds_{tangle}.nc")
    lengths = {side: each["length"] for side, each in scenes[tangle]["branches"].items()}
    names = "saddle", "side", "stable"
    rows = zip(*(branches[each].values.tolist() for each in names), strict=True)
    specs = [dict(zip(names, row, strict=True)) | {"length": lengths[row[1]]} for row in rows]
    points = [[row[0], row[1], row[2]] for row in saddle]
    lines = person.run(BRANCHES, values_of(scenes[tangle]) | {"points": points}, specs)
    for variable, column in zip(STATE, lines, strict=True):
        drawn = np.array([np.nan if value is None else value for value in column])
        assert np.allclose(branches[variable].values, drawn, rtol=0.0, atol=1e-9, equal_nan=True)


def values_of(block):
    """Return what a job of the page's worker needs to know of a scene."""
    return {**block["ball"], "energy": block["energy"]}


PERIODIC = "return new Computer().ask('periodic', args[0]);"
BRANCHES = """
const [values, specs] = args, worker = new Computer(), columns = [[], [], []];
for (const spec of specs) {
  const line = await worker.ask("branch", { ...values, spec });
  [line.x, line.xdot, line.udot].forEach((column, i) => columns[i].push(...column));
}
return columns;
"""


def zoomed(person):
    """Zoom in until the view is a millionth of the section, and start orbits there."""
    person.press("clear")
    person.run(
        "const s = document.getElementById('section'); s.scrollIntoView({block: 'center'});"
        "const b = s.getBoundingClientRect();"
        "for (let i = 0; i < 35; i++) s.dispatchEvent(new WheelEvent('wheel', {deltaY: -240,"
        " clientX: b.left + 0.4 * b.width, clientY: b.top + 0.3 * b.height, cancelable: true}))"
    )
    assert float(person.state()["view"].split(",")[5]) < 1e-6
    for at in ((0, 0), (40, -30), (-60, 20)):
        person.pointer(at).click().perform()
    assert len(person.settled()) == 3
