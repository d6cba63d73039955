"""A box to zoom into, orbits that run on, periodic orbits near a click, and colours by numbers."""

import numpy as np
import pytest
from selenium.webdriver import Keys

from helpers.parts.person import DISK, WHOLE
from helpers.project import wait_for
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import of_type

pytestmark = pytest.mark.slow  # it sees no figure
BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
NEAREST = """return pseudorigid && new Computer().ask("near",
    { k: 0.2, g: 0.04, energy: 0.01, p: args[0], q: args[1], period: args[2] })"""


@pytest.mark.parametrize("way", ["shift", "touch"])
def test_a_box_fills_the_view(person, way):
    """Its middle is the view's middle, whichever corner comes first, and no orbit starts."""
    person.open(DISK)
    ends = person.spot(-0.5, 0.3), person.spot(0.1, -0.3)
    if way == "shift":
        chain = person.pointer(ends[1]).key_down(Keys.SHIFT).click_and_hold()
        chain.move_to_element_with_offset(person.find("section"), *ends[0]).release()
        chain.key_up(Keys.SHIFT).perform()
    else:
        person.press("box")
        assert person.find("box").get_attribute("aria-pressed") == "true"
        box = person.find("section").rect
        (a, b), (c, d) = [(0.5 + e[0] / box["width"], 0.5 + e[1] / box["height"]) for e in ends]
        person.dispatch("pointerdown pointermove", a, b, pointerType="touch")
        person.dispatch("pointermove pointerup", c, d, pointerType="touch")
        assert person.find("box").get_attribute("aria-pressed") == "false"
    view = person.view()
    assert (view.x, view.y) == pytest.approx((-0.2, 0.0), abs=0.01)
    assert view.half < 0.6 * WHOLE
    assert person.starts() == []


def test_an_orbit_runs_on_until_it_is_stopped(person):
    person.open(f"{DISK}&orbits=0.5*100;0.534522*100&chosen=1")
    person.press("run-on")
    count = "return Number(facts()[1].split(' ')[0].replaceAll(',', ''))"
    wait_for(lambda: person.run(count) > 20_000)
    assert person.text("run-on") == "Stop"
    person.press("run-on")
    person.settle()
    assert person.text("run-on") == "Continue"
    impacts = person.run(count)
    assert person.state()["orbits"] == f"0.5*100;0.534522*{impacts}"
    person.reload()  # the link has the same orbit
    found = person.states()
    expected = BALL.after(BALL.start(0.534522, ENERGY), impacts)
    assert len(found) == impacts + 1 and found[-1].tolist() == np.ravel(expected)[:3].tolist()


def test_the_nearest_orbit_is_python_s_where_it_is_symmetric(person):
    centre, radius = BALL.section(ENERGY)[:2]
    height = np.sqrt(BALL.k * (1 + BALL.k)) * radius
    for period in (1, 5, 6, 10):
        for row in range(symmetric_orbits(BALL, ENERGY, period).sizes["orbit"]):
            orbit = symmetric_orbits(BALL, ENERGY, period).isel(orbit=row)
            x, y = orbit["x"].values, orbit["xdot"].values - BALL.k * orbit["udot"].values
            p, q = (x[0] - centre) / radius + 3e-4, y[0] / height - 2e-4
            for wanted in (period, 0):
                one = person.run(NEAREST, p, q, wanted)
                if wanted or one["period"] == period:
                    assert one["type"] == orbit["type"].item()
                    assert one["trace"] == pytest.approx(orbit["trace"].item(), rel=1e-8, abs=1e-8)
                    assert np.allclose([point[0] for point in one["points"]], x, atol=1e-11)


@pytest.mark.parametrize("period", [*range(0, 25, 3), 23])
def test_found_orbits_close_and_have_their_prime_period(person, period):
    for p, q in ((0.2, 0.3), (-0.2, 0.05), (0.6, -0.2)):
        one = person.run(NEAREST, p, q, period)
        if one is None:
            continue
        assert one["period"] == (period or one["period"]) <= 24
        points = np.array(one["points"])
        after = np.ravel(BALL.after(points[0, :3], one["period"]))[:3]
        assert np.allclose(after, points[0, :3], atol=1e-15 * max(10.0, 10 * abs(one["trace"])))
        apart = np.abs(points[1:, :3] - points[0, :3]).max(axis=1, initial=0.0)
        assert np.all(apart > 1e-7) or one["period"] == 1
        trace = np.trace(BALL.chart_jacobian(*points[0, :3], one["period"]))
        assert one["trace"] == pytest.approx(trace, rel=1e-6, abs=1e-6)


def test_a_click_finds_a_saddle_with_its_branches_and_the_link_keeps_them(person):
    saddle = of_type(symmetric_orbits(BALL, ENERGY, 6), "hyperbolic").isel(point=0)
    centre, radius = BALL.section(ENERGY)[:2]
    height = np.sqrt(BALL.k * (1 + BALL.k)) * radius
    y = (saddle["xdot"] - BALL.k * saddle["udot"]).item()
    person.open(DISK)
    person.press("tab-periodic")
    person.set("near-period", "6")
    person.press("pick")
    person.click((saddle["x"].item() - centre) / radius, y / height)
    wait_for(lambda: "4 branches" in person.text("branch-note"))
    assert person.starts() == []  # no orbit has started there
    residue = 0.25 * (2 - saddle["trace"].item())
    assert f"period 6: hyperbolic, residue {residue:.5g}".replace("-", "−") in person.text("hint")
    facts = person.text("periodic")
    state = person.state()
    assert state["motion"] == "0n0" and state["branches"].startswith("0n0,0,both,both,")
    person.dispatch("pointerleave", 0, 0)  # the place under the pointer is written on the section
    picture = person.still()
    person.open(person.run("return location.hash.slice(1)"))
    wait_for(lambda: "4 branches" in person.text("branch-note"))
    assert person.text("periodic") == facts and person.state() == state
    assert np.mean(np.any(person.still() != picture, axis=2)) < 1e-3
    person.click(0.5, 0.3)  # clicks start orbits again
    assert len(person.settled()) == 1
    person.press("forget")
    assert "near" not in person.state() and person.text("periodic") == ""


def test_the_verdict_on_an_orbit_does_not_depend_on_its_run(person):
    """Short orbits are followed further."""
    orbits = "0.9999999*3000;0.9999999*600;0.9999999*15000;-0.2*600;-0.2*3000;0.6*600;-0.2*100"
    person.open(f"{DISK}&orbits={orbits}")
    found = [row["verdict"] for row in person.settled()]
    assert found == ["chaotic"] * 3 + ["regular"] * 2 + ["chaotic", "regular"]


@pytest.mark.parametrize(("start", "impacts"), [(0.534522, 200), (-0.3, 1000)])
def test_two_balls_separate_as_in_python(person, start, impacts):
    person.open(f"{DISK}&orbits={start}*2000&chosen=0")
    person.set("apart", "1e-5")
    person.press("twin")
    person.settle()
    wait_for(lambda: "after" in person.text("twin-note"))
    one = np.array(BALL.start(start, ENERGY))
    other = BALL.state_xy(one[0] + 1e-5, one[1] - BALL.k * one[2], ENERGY)
    x, xdot, udot, _ = (BALL.history(other, impacts)[0] - BALL.history(tuple(one), impacts)[0]).T
    apart = np.hypot(x, (xdot - BALL.k * udot) / np.sqrt(BALL.k * (1 + BALL.k)))
    note = person.text("twin-note")
    assert f"after {impacts} impacts are {float(f'{apart[-1]:.2g}'):g} apart" in note
    if impacts == 1000:
        assert "in proportion" in note
        return
    first = np.argmax(apart > 0.02 * BALL.section(ENERGY)[1])
    logs = np.log([1e-5, *apart[:first]])
    assert f"exp({np.polyfit(np.arange(first + 1), logs, 1)[0]:.2g})" in note
    assert person.state()["twin"] == "0.00001" and person.state()["chart"] == "distance"
