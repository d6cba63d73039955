"""Windows that fill themselves, the section in colour, the tour, families, and messages."""

import json
import re

import numpy as np
import pytest
from selenium.webdriver import Keys

from extensions.atlas.symmetry_line import symmetric_fixed_point
from extensions.explorer import page
from helpers.parts.person import DISK
from helpers.project import wait_for
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import of_type

pytestmark = pytest.mark.slow  # they see no figure
BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
TOUR = json.loads((page.WEB / "tour.json").read_text("utf-8"))


def note(person, words):
    wait_for(lambda: words in person.text("map-note"))
    return person.text("map-note")


def differing(one, other):
    return np.mean(np.any(one != other, axis=2))


def test_the_tour_goes_on_and_back_and_ends(person):
    person.press("tour-start")
    for number, step in enumerate(TOUR, 1):
        person.settle()
        assert person.text("guide-title") == f"{number} of 6. {step['title']}"
        state = person.state()
        assert state["tour"] == str(number) and f"E={state['E']}&" in step["address"] + "&"
        person.press("guide-next")
    assert not person.find("guide").is_displayed()
    person.press("undo")
    wait_for(lambda: person.find("guide").is_displayed())
    person.press("guide-back")
    assert person.state()["tour"] == "5"


@pytest.mark.parametrize("way", ["box", "wheel", "keys"])
def test_a_window_fills_itself_after_a_zoom_and_again_from_its_address(person, way):
    person.open(DISK)
    if way == "box":
        person.press("box")
        person.drag(person.spot(-0.05, 0.45), person.spot(0.15, 0.25))
    elif way == "wheel":
        for _ in range(6):
            person.dispatch("wheel", 0.5, 0.45, deltaY=-240)
    else:
        person.run("document.getElementById('section').focus()")
        person.find("section").send_keys(*"++++++")
    orbits, regular = re.findall(r"\d[\d,]*", note(person, "is full"))[:2]
    assert int(orbits.replace(",", "")) > int(regular.replace(",", "")) > 5
    person.dispatch("pointerleave", 0, 0)
    person.run("document.activeElement.blur()")
    picture, address = person.pixels(), person.run("return location.hash.slice(1)")
    assert "fill=1" in address
    person.open(address)
    note(person, "is full")
    assert differing(person.pixels(), picture) < 1e-3
    person.press("home")
    assert "fill" not in person.state()


def test_a_window_to_which_no_orbit_returns_says_so(person):
    person.open("view=disk,115,40,0.3,0.2,1e-12&fill=1")
    assert "too rarely" in note(person, "orbits began")


def test_impacts_that_are_not_kept_are_drawn_and_saved_again(person):
    person.open(f"{DISK}&orbits=0.534522*120000&chosen=0")
    drawn = person.pixels()
    person.press("as-surface")
    person.press("as-disk")
    wait_for(lambda: differing(person.pixels(), drawn) < 1e-3)
    last = person.table()[1][-1]
    expected = BALL.after(BALL.start(0.534522, ENERGY), 120_000)
    assert last["impact"] == "120000"
    assert [float(last[n]) for n in ("x", "xdot", "udot", "tau")] == np.ravel(expected).tolist()


def test_the_section_in_colour_follows_the_energy_and_has_the_share_of_the_map(person):
    person.open(f"{DISK}&map=verdict")
    share = float(re.search(r"regular ([\d.]+) %", note(person, "200 × 200 cells"))[1])
    assert 15 < share < 20  # the atlas has 17 %
    assert "100.0 % decided" in person.text("map-note")
    before = person.pixels()
    person.set("E-slide", 0.2)
    wait_for(lambda: f"regular {share} %" not in person.text("map-note"))
    assert float(re.search(r"regular ([\d.]+) %", note(person, "200 × 200 cells"))[1]) > 30
    assert differing(person.pixels(), before) > 0.05
    for by in ("exponent", "rotation"):
        person.set("map", by)
        note(person, "300 × 300 cells, 200 impacts each")
        assert person.state()["map"] == by
    person.set("map", "none")
    assert "map" not in person.state() and person.text("map-note") == ""


def test_play_e_raises_the_energy_and_is_undone_at_once(person):
    person.open(f"E=-0.003&{DISK}&map=exponent")
    person.press("play-energy")
    wait_for(lambda: float(person.state()["E"]) > 0)
    person.press("play-energy")
    assert person.text("play-energy") == "Play E"
    energy = person.state()["E"]
    assert person.state()["E"] == energy and person.value("E") == energy
    person.press("undo")
    wait_for(lambda: person.state()["E"] == "-0.003")


def test_a_click_on_a_mark_names_the_orbit_and_its_branches_grow(person):
    saddle = of_type(symmetric_orbits(BALL, ENERGY, 6), "hyperbolic").isel(point=0)
    centre, radius, height = BALL.section(ENERGY)[0], BALL.section(ENERGY)[1], np.sqrt(0.24)
    y = (saddle["xdot"] - BALL.k * saddle["udot"]).item()
    person.open(f"{DISK}&periods=6")
    wait_for(lambda: "3 symmetric" in person.text("periodic-note"))
    person.click((saddle["x"].item() - centre) / radius, y / (height * radius))
    residue = 0.25 * (2 - saddle["trace"].item())
    assert f"period 6: hyperbolic, residue {residue:.5g}".replace("-", "−") in person.text("hint")
    assert person.starts() == []
    wait_for(lambda: "24 branches" in person.text("branch-note"))
    traced = person.text("branch-note")
    person.press("jump")
    wait_for(lambda: "jumps across" in person.text("jump-note"))
    assert person.text("branch-note") == traced  # not traced again


def test_the_orbit_under_the_pointer_is_named(person):
    person.open(f"{DISK}&orbits=0.534522*2000;-0.2*2000")
    person.pointer(person.spot(-0.2)).perform()
    wait_for(lambda: "orbit 2: regular, rotation number 0.176" in person.text("where"))


def test_families_have_the_energy_at_which_the_islands_are_born(person):
    person.open(f"{DISK}&periods=6&chart=families")
    ends = "return [...document.querySelectorAll('#families button')].map(b => b.textContent)"
    wait_for(lambda: len(person.run(ends)) == 6, 120)
    birth = float(person.run(ends)[0].removeprefix("E = "))
    assert symmetric_fixed_point(BALL, birth)[1] == pytest.approx(1 / 6, abs=1e-6)
    person.run("document.querySelector('#families button').click()")
    wait_for(lambda: "after impact 0" in person.text("moment"))
    assert float(person.state()["E"]) == pytest.approx(birth, rel=1e-4)


def test_messages_end_and_an_address_says_what_it_leaves_out(person):
    person.open("&".join([DISK, "orbits=" + ";".join(["0.5*10"] * 70)]))
    assert "last 6 orbits" in person.text("hint")
    person.press("clear")
    person.press("box")
    assert "Drag a box" in person.text("hint")
    person.press("box")
    assert "Drag a box" not in person.text("hint")


def test_pictures_offer_their_variants(person):
    options = "return [...document.getElementById(args[0]).options].map(o => o.value)"
    assert len(person.run(options, "preset")) <= 21  # with one's own
    person.set("preset", "fig8")
    assert "below/fig8" in person.run(options, "variant")
    person.set("variant", "below/fig8")
    assert person.state()["preset"] == "below/fig8" and person.value("preset") == "fig8"
    person.find("section").send_keys(Keys.ENTER, Keys.ENTER)  # a start of one's own
    assert not person.find("variant").is_displayed()


def test_pressed_buttons_stand_out_in_forced_colours(person):
    media = {"features": [{"name": "forced-colors", "value": "active"}]}
    person.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", media)
    colour = "return getComputedStyle(document.getElementById(args[0])).backgroundColor"
    assert person.run(colour, "as-surface") != person.run(colour, "as-disk")
    person.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
