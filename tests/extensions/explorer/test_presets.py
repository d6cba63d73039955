"""Copy as a scene: the block for config.yaml has the picture of the page, to the last bit."""

import numpy as np
import pytest
import yaml

from helpers.project import Tree, shipped, wait_for
from pipeline.records.artifacts import load


def copied(person, kind):
    """Copy what is on the page as a scene of a kind, and return its name and its block."""
    person.set("scene-kind", kind)
    person.press("copy-scene")
    wait_for(lambda: "config.yaml" in person.text("scene-note"))
    text = person.value("scene")
    ((name, block),) = yaml.safe_load(text).items()
    assert block["picture"] == kind
    assert max(map(len, text.splitlines())) <= 100
    return name, block


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
    person.set("preset", "jumps")
    person.settled()
    copy("jumps")
    person.set("preset", "fig4")
    wait_for(lambda: "3 symmetric" in person.text("periodic-note"))
    motion = copy("motion")
    person.set("preset", "fig5")
    person.settled()
    tangle = copy("tangle")
    person.set("preset", "fig6")
    wait_for(lambda: "24 branches" in person.text("branch-note"))
    copy("closeup")

    assert len(scenes) == 8
    tree = Tree(tmp_path)
    tree.write(shipped() | {"scenes": scenes, "variants": {}})
    tree.make_here(*[f"results/paper/figures/{name}.png" for name in scenes])
    for name, expected in orbits.items():
        dataset = load(tree.path / f"results/paper/orbits_{name}.nc")
        for variable, values in expected.items():
            assert np.array_equal(dataset[variable].values, values), (name, variable)

    assert (scenes[motion]["period"], scenes[motion]["type"]) == (6, "elliptic")
    assert (scenes[tangle]["period"], scenes[tangle]["type"]) == (6, "hyperbolic")


def zoomed(person):
    """Zoom in until the view is a millionth of the section, and start orbits there."""
    person.press("clear")
    for _ in range(35):
        person.dispatch("wheel", 0.4, 0.3, deltaY=-240)
    assert person.view().half < 1e-6
    for at in ((0, 0), (40, -30), (-60, 20)):
        person.pointer(at).click().perform()
    assert len(person.settled()) == 3
