"""The explorer's manners: undo, reload, exact starts, words, colours and files."""

import struct
from xml.etree import ElementTree

import numpy as np
import pytest
from project import wait_for
from selenium.webdriver import Keys

from pseudorigid import Ball

pytestmark = pytest.mark.slow  # it sees no figure, and takes minutes
BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01


def test_undo_goes_through_presets_starts_clears_and_parameters(person):
    def undo_by_keys():
        person.chain().key_down(Keys.CONTROL).send_keys("z").key_up(Keys.CONTROL).perform()

    first = person.starts()
    assert person.run("return document.getElementById('undo').disabled")
    person.browser.click("#section")
    wait_for(lambda: len(person.starts()) == 9)
    person.press("clear")
    assert person.starts() == []
    person.set("preset", "fig8")
    assert person.state()["preset"] == "fig8"
    person.set("E-slide", 0.5, 0.45, 0.4, 0.42)
    after = person.state()["E"]
    assert after != "0.001"
    person.run("document.activeElement.blur()")
    undo_by_keys()  # the whole drag
    wait_for(lambda: person.state()["E"] == "0.001")
    assert person.state()["preset"] == "fig8" and person.value("preset") == "fig8"
    undo_by_keys()
    wait_for(lambda: person.starts() == [])
    person.run("history.back()")
    wait_for(lambda: len(person.starts()) == 9)
    person.press("undo")
    wait_for(lambda: person.starts() == first)
    assert person.state()["preset"] == "fig2"
    assert person.run("return document.getElementById('undo').disabled")
    for _ in range(4):
        person.run("history.forward()")
        person.state()
    assert person.state()["E"] == after


def test_a_reload_restores_everything(person):
    person.press("theme")
    person.press("find")
    person.set("speed", "6")
    person.set("k", "0.25")
    person.press("by-verdict")
    shown = (
        "return [document.documentElement.dataset.theme, speed.value,"
        " [...document.querySelectorAll('details[open]')].map(n => n.id), see.textContent,"
        " [...document.querySelectorAll('[aria-pressed]')].map(n => n.ariaPressed)]"
    )
    state, before = person.state(), person.run(shown)
    person.reload()
    assert person.state() == state
    assert person.run(shown) == before
    person.press("undo")
    wait_for(lambda: person.state()["k"] == "0.2")
    assert person.run(shown)[0] == before[0]  # the theme stays
    person.press("theme")


def test_pictures_say_what_they_show(person):
    state = person.state()
    hashed = person.run("return location.hash")
    width = person.run(
        "return Math.round(document.getElementById('section').getBoundingClientRect().width)"
    )
    for name, ratio in (("png2", 2), ("png4", 4)):
        kind, content = person.saved(name)
        assert kind == "image/png"
        assert struct.unpack(">I", content[16:20])[0] == ratio * width
    kind, content = person.saved("svg")
    assert kind == "image/svg+xml"
    root = ElementTree.fromstring(content)
    space = "{http://www.w3.org/2000/svg}"
    texts = "".join(node.text for node in root.iter(f"{space}text"))
    for words in (texts, root.find(f"{space}metadata").text):
        assert "k = 0.2, g = 0.04, E = 0.01" in words and hashed in words
    dots = sum(node.get("d").count("h0") for node in root.iter(f"{space}path"))
    impacts = sum(int(part.split("*")[1].strip("!")) for part in state["orbits"].split(";"))
    assert 0.5 * impacts < dots <= impacts  # the surface hides some


def test_csv_of_all_orbits_says_what_they_are(person):
    comments, rows = person.table("csv-all")
    assert "# k = 0.2, g = 0.04, E = 0.01" in comments
    assert any("explorer.html#k=0.2" in line for line in comments) and len(comments) == 3
    last = [row for row in rows if row["orbit"] == "8"]
    assert len(last) == 25001 and {row["orbit"] for row in rows} == set("12345678")
    expected = BALL.after(BALL.start(0.534522, ENERGY), 25000)
    found = [float(last[-1][name]) for name in ("x", "xdot", "udot", "tau")]
    assert found == np.ravel(expected).tolist()
