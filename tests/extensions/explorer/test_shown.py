"""What the explorer shows stands out, has names and numbers, and stays in sight."""

import re
from xml.etree import ElementTree

import pytest
from person import DISK

pytestmark = pytest.mark.slow  # it sees no figure


def test_no_orbit_is_called_regular_before_it_has_made_a_whole_turn(person):
    """Short orbits are followed further."""
    orbits = "0.9999999*3000;0.9999999*600;0.9999999*15000;-0.2*600;-0.2*3000;0.6*600;-0.2*100"
    person.open(f"{DISK}&orbits={orbits}")
    found = [row["verdict"] for row in person.settled()]
    assert found[:3] == ["undecided", "undecided", "chaotic"]
    assert found[3:] == ["regular", "regular", "chaotic", "too short for a verdict"]


@pytest.mark.parametrize("magnified", ["0,0,1.12", "0.1,0.1,0.3", "-0.1,0.2,1e-5", "0,0.1,1e-9"])
def test_the_half_ellipsoid_has_numbers_at_its_axes(person, magnified):
    for view in ("115,40", "30,20", "250,70"):
        person.open(f"orbits=0.1*10&view=surface,{view},{magnified}")
        root = ElementTree.fromstring(person.saved("svg")[1])
        _, _, width, height = map(float, root.get("viewBox").split())
        texts = [
            node.text
            for node in root.iter("{http://www.w3.org/2000/svg}text")
            if 0 < float(node.get("x")) < width and 0 < float(node.get("y")) < height
        ]
        assert {"x", "ẋ⁻", "u̇⁻"} <= {text.split(" ")[0] for text in texts}
        assert sum(bool(re.fullmatch(r"[−\de.]+", text)) for text in texts) >= 6


def test_the_section_stays_in_sight_on_a_phone(phone):
    for name in ("k-slide", "g-slide", "E-slide"):
        section, slide = phone.run(
            "const [a, b] = ['section', args[0]].map(n => document.getElementById(n));"
            "b.scrollIntoView({block: 'center'});"
            "return [a, b].map(n => n.getBoundingClientRect())",
            name,
        )
        assert section["top"] >= 0 and section["bottom"] < slide["top"]
        assert slide["bottom"] < 844
