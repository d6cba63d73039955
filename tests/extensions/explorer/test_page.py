"""The explorer's page in Chromium, used as a person uses it: pointer, touch, keys and fields."""

import struct
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
from axe_core_python.selenium import Axe
from selenium.webdriver import Keys
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

from extensions.atlas.symmetry_line import winding
from extensions.claims.analyses.jumps import jumps
from helpers.parts.person import WHOLE, Visitor
from helpers.project import shipped, wait_for
from pseudorigid import Ball, lyapunov_spectrum, symmetric_orbits, trace_manifold
from pseudorigid.dynamics.regularity import orbit_types
from pseudorigid.dynamics.variables import of_type
from pseudorigid.figures.axes import raster

pytestmark = pytest.mark.slow  # it sees no figure, and takes minutes
BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
K, G = BALL.k, BALL.g
# Ask a job of a worker like the page's own.
JOB = "const worker = new Computer(); const [job, values] = args; return worker.ask(job, values);"


def test_the_first_picture_is_figure_2_with_python_s_facts(person):
    scene = shipped()["scenes"]["fig2"]
    rows = person.settled()
    assert [row["impacts"] for row in rows] == scene["impacts"]
    assert person.state()["preset"] == "fig2"
    for row, start, impacts in zip(rows, scene["starts"], scene["impacts"], strict=True):
        state = BALL.start(start, ENERGY)
        exponent = float(lyapunov_spectrum(BALL, state, impacts, 1)["exponent"][0, 0])
        assert float(row["exponent"]) == pytest.approx(exponent, rel=6e-4)
        turns, _ = winding(BALL, ENERGY, np.array([start]), impacts)
        assert [row["verdict"]] == orbit_types(BALL, np.array(state)[:, None])
        if row["verdict"] == "regular":
            assert float(row["rotation"]) == pytest.approx(turns[0], abs=2e-8)


def test_a_backward_orbit_is_the_inverse_map_s(person):
    person.clear_disk()
    person.type("impacts", "300")
    person.press("back")
    person.click(0.31, 0.22)
    assert "backwards" in person.settled()[0]["verdict"]
    found = person.states()
    for before, state in pairwise(found[:41]):
        assert np.allclose(BALL.inverse_impact(*before)[:3], state, atol=1e-10)
    assert person.table()[1][1]["impact"] == "-1"


def test_dragging_along_the_symmetry_line_shoots_a_fan(person):
    person.clear_disk()
    person.drag(person.spot(-0.4), person.spot(0.5))
    rows = person.settled()
    starts = [float(row["start"]) for row in rows]
    assert len(rows) == 12
    assert np.allclose(starts, np.linspace(starts[0], starts[-1], 12), atol=2e-4)
    assert (starts[0], starts[-1]) == pytest.approx((-0.4, 0.5), abs=0.02)


def test_dragging_turns_the_surface_and_moves_the_disk(person):
    before = person.pixels()
    person.drag((150, 120), (60, 80))
    view = person.view()
    assert view.kind == "surface"
    assert view.azimuth != 115 and view.elevation != 40
    assert not np.array_equal(before, person.pixels())
    person.press("as-disk")
    person.drag(person.spot(0.2, 0.6), person.spot(0.4, 0.4))
    view = person.view()
    assert (view.x, view.y) == pytest.approx((-0.2, 0.2), abs=0.02)


def test_the_wheel_zooms_without_limit_at_the_pointer(person):
    person.press("as-disk")
    person.pointer(person.spot(0.3, 0.2)).perform()
    before = person.place()
    origin = ScrollOrigin.from_element(person.find("section"), *person.spot(0.3, 0.2))
    for _ in range(70):
        person.chain().scroll_from_origin(origin, 0, -240).perform()
    assert person.view().half < 1e-13
    person.pointer((40, 40)).perform()
    assert before == pytest.approx(person.place(), abs=3e-3)
    person.pointer((40, 40)).click().perform()
    assert person.settled()[-1]["impacts"] == 3000


def test_one_finger_turns_the_surface_and_the_page_stays(phone):
    def touch(kind, *points):
        at = [{"x": 195 + x, "y": 250 + y} for x, y in points]
        command = {"type": kind, "touchPoints": at}
        phone.driver.execute_cdp_cmd("Input.dispatchTouchEvent", command)

    def swipe():
        """Return how far the page scrolled, and the view."""
        touch("touchStart", (-60, 100))
        for step in range(1, 9):
            touch("touchMove", (-60 + 5 * step, 100 - 15 * step))
        touch("touchEnd")
        return phone.run("return window.scrollY"), phone.view()

    before = phone.view()
    scrolled, view = swipe()
    assert scrolled == 0 and view != before
    assert len(phone.starts()) == 8


def test_the_keyboard_does_everything(person):
    person.press("clear")
    box = person.find("section")
    person.run("document.getElementById('section').focus()")
    box.send_keys(*[Keys.ARROW_RIGHT] * 3, *[Keys.ARROW_DOWN] * 2, Keys.ENTER)
    assert len(person.settled()) == 1
    wait_for(lambda: person.text("play") == "Pause")
    box.send_keys(Keys.SPACE)
    wait_for(lambda: person.text("play") == "Play")
    view = person.view()
    box.send_keys("+")
    assert person.view() != view
    box.send_keys("0", Keys.SHIFT + Keys.ARROW_LEFT)
    assert person.view().azimuth != 115
    box.send_keys(Keys.NULL, "f", *[Keys.ARROW_LEFT] * 3, "f")
    assert len(person.settled()) == 13
    box.send_keys(Keys.SPACE)
    wait_for(lambda: person.text("play") == "Play")
    person.press("tab-time")
    curves = person.find("curves")
    now = float(person.state()["t"])
    curves.send_keys(Keys.ARROW_RIGHT)
    assert float(person.state()["t"]) == pytest.approx(now + 0.16)
    curves.send_keys(Keys.PAGE_UP)
    assert float(person.state()["t"]) > now


def test_bad_input_of_a_form_is_a_line_beside_it_and_the_picture_stays(person):
    person.reveal("start-x")
    person.settle()  # the pointer has left the section, where it highlights an orbit
    before = person.pixels()
    person.submit("start-x", "3")
    assert "outside the section" in person.text("start-error")
    person.submit("fan-count", "1")
    assert "2 to 64" in person.text("fan-error")
    assert len(person.starts()) == 8
    assert np.mean(np.any(before != person.pixels(), axis=2)) < 1e-3
    person.press("find")
    wait_for(lambda: "3 symmetric orbits" in person.text("periodic-note"))
    person.submit("branch-length", "-1")
    assert "above 0" in person.text("branch-error")


def test_a_change_of_the_ball_keeps_the_starts_as_fractions(person):
    starts = person.state()["orbits"]
    person.type("E", "0.008")
    rows = person.settled()
    assert person.state()["orbits"] == starts
    assert person.state()["E"] == "0.008"
    exponent = lyapunov_spectrum(BALL, BALL.start(0.534522, 0.008), 25000, 1)["exponent"]
    assert float(rows[-1]["exponent"]) == pytest.approx(float(exponent[0, 0]), rel=6e-4)
    person.set("k-slide", 0.5)
    wait_for(lambda: person.state()["k"] == "0.25")
    assert "E_g = g²(1 + k/2) = 0.0018" in person.text("bounds")


def test_periodic_orbits_are_those_of_python(person):
    for period in (1, 5, 6):
        expected = symmetric_orbits(BALL, ENERGY, period)
        values = {"k": K, "g": G, "energy": ENERGY, "period": period}
        found = person.run(JOB, "periodic", values)
        assert [one["type"] for one in found] == expected["type"].values.tolist()
        for row, one in enumerate(found):
            orbit = expected.isel(orbit=row)
            names = {"trace": "trace", "time": "total_time"}
            if one["type"] == "elliptic":
                names["rotation"] = "rotation_number"
            for name, variable in names.items():
                assert one[name] == pytest.approx(float(orbit[variable]), rel=1e-9, abs=1e-9)
            xs = sorted(point[0] for point in one["points"])
            assert np.allclose(xs, np.sort(orbit["x"].values), atol=1e-12)


@pytest.mark.parametrize(
    ("energy", "period", "length", "side", "stable"),
    [(0.01, 6, 1.5, "inner", False), (0.001, 10, 0.3, "outer", True)],
)
def test_branches_are_those_of_python(person, energy, period, length, side, stable):
    saddle = of_type(symmetric_orbits(BALL, energy, period), "hyperbolic")
    points = np.stack([saddle[name].values for name in ("x", "xdot", "udot")], axis=1).tolist()
    expected = trace_manifold(BALL, energy, saddle, 1, stable=stable, side=side, length=length)
    spec = {"saddle": 1, "stable": stable, "side": side, "length": length}
    values = {"k": K, "g": G, "energy": energy, "points": points, "spec": spec}
    take = "const line = await worker.ask(job, values);"
    take += "return [line.x, line.xdot, line.udot].map(a => [...a])"
    script = JOB.replace("return worker.ask(job, values)", take)
    found, radius = np.array(person.run(script, "branch", values)), BALL.section(energy)[1]
    reference = np.stack([expected[name].values for name in ("x", "xdot", "udot")])
    assert found.shape == reference.shape
    assert np.allclose(found, reference, rtol=0.0, atol=1e-12 * radius)


def test_the_jump_curve_has_python_s_length(person):
    expected = float(jumps(BALL, ENERGY, [0.001], 4000)["length"][0])
    curve = person.run(JOB, "jump", {"k": K, "g": G, "energy": ENERGY})
    assert curve["length"] == pytest.approx(expected, rel=1e-9)
    person.press("tab-periodic")
    person.press("jump")
    wait_for(lambda: "0.404858" in person.text("jump-note"))
    person.type("E", "0.001")
    wait_for(lambda: "continuous" in person.text("jump-note"))


def test_the_ball_in_time_steps_from_impact_to_impact(person):
    person.set("preset", "fig4")
    wait_for(lambda: "impact 0" in person.text("moment"))
    six = of_type(symmetric_orbits(BALL, ENERGY, 6), "elliptic")
    times = np.concatenate([[0.0], np.cumsum(six["tau"].values)])
    views = "return ['#ball', '#curves', '#section .cursors'].map(s => document.querySelector(s)"
    views += ".toDataURL())"
    before = person.run(views)
    for when in times[1:]:
        person.press("next-impact")
        assert float(person.state()["t"]) == pytest.approx(when, abs=1e-9)
        now = person.run(views)  # one cursor in all views
        assert all(a != b for a, b in zip(before, now, strict=True))
        before = now
    person.press("back-impact")
    assert float(person.state()["t"]) == pytest.approx(times[-2], abs=1e-9)
    person.press("play")
    wait_for(lambda: float(person.state()["t"]) > times[-2] + 0.5)
    person.press("play")
    assert person.text("play") == "Play"


def test_every_preset_draws_and_has_one_sentence(person):
    options = "return [...document.querySelectorAll('#preset option')].map(o => o.value)"
    own, *names = person.run(options)
    assert own == ""
    scenes = person.run("return Object.keys(JSON.parse(data.textContent).scenes)")
    assert set(names) == {name for name in scenes if "/" not in name}
    seen = []
    for name in names:
        person.set("preset", name)
        wait_for(lambda: "…" not in person.text("branch-note") + person.text("periodic-note"))
        person.settle()
        assert person.text("see").endswith(".")
        seen.append(person.pixels().tobytes())
        assert person.state()["preset"] == name
    assert len(set(seen)) == len(names)


def test_a_bad_address_is_a_line_and_shows_figure_2(person):
    for wrong in ("k=0", "orbits=2*10", "%E0%A4%A", "view=cube,1,2,3,4,5", "fig99"):
        person.open(wrong)
        assert "address" in person.text("hint")
        assert len(person.starts()) == 8
    assert "has fig99:" in person.text("hint")


def test_the_atlas_goes_to_a_ball_and_an_energy_by_pointer_and_keys(person):
    person.press("tab-atlas")
    canvas, small = person.find("atlas"), "return document.getElementById('peek').toDataURL()"
    canvas.send_keys(*[Keys.ARROW_DOWN] * 3, *[Keys.ARROW_LEFT] * 2)
    assert "k = 0.17, E/g² = 4.96: regular share" in person.text("atlas-note")
    canvas.send_keys(Keys.ENTER)
    wait_for(lambda: person.state()["k"] == "0.17")
    assert float(person.state()["E"]) == pytest.approx(4.96 * 0.04**2)
    before = person.run(small)
    person.pointer((30, -20), "atlas").perform()
    wait_for(lambda: person.run(small) != before)  # the section there
    person.pointer((30, -20), "atlas").click().perform()
    state = person.state()
    k, g, energy = (float(state[name]) for name in ("k", "g", "E"))
    assert k != 0.17 and energy < k / 2 - g
    assert f"k = {state['k']}" in person.text("hint")
    assert len(person.settled()) == 8


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


def test_the_atlas_has_the_colours_of_its_picture(person):
    shares = np.arange(64) / 63
    shown = person.run("return args[0].map(shade)", shares.tolist())
    shown = np.array([[*bytes.fromhex(colour[1:])] for colour in shown])
    assert np.abs(shown - raster.palette("viridis")).max() < 20


@pytest.mark.parametrize(("width", "theme"), [(360, "dark"), (2000, "light")])
def test_the_page_fits_and_is_legible(person, width, theme):
    """An accessibility checker finds nothing, in any panel."""
    metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    person.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    try:
        person.open()
        if theme != person.run("return document.documentElement.dataset.theme"):
            person.press("theme")
        for name in ("chart", "orbits", "periodic", "atlas", "export", "help", "time", "guide"):
            person.press("lesson-start" if name == "guide" else f"tab-{name}")
            if name == "time":
                person.reveal("twin")  # in the menu
            room, needed = person.run(
                "const e = document.documentElement; return [e.clientWidth, e.scrollWidth]"
            )
            assert needed <= room
            broken = Axe().run(person.driver)["violations"]
            assert [(rule["id"], node["html"]) for rule in broken for node in rule["nodes"]] == []
    finally:
        person.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_a_walk_through_the_page_in_firefox(firefox, address):
    """By pointer, fingers and fields, with a saved file, a reload and undo."""
    visitor = Visitor(firefox, address)
    visitor.open()
    exponent = lyapunov_spectrum(BALL, BALL.start(0.534522, ENERGY), 25000, 1)["exponent"]
    assert f"exponent {float(exponent[0, 0]):.4g} " in visitor.run("return facts().at(-1)")
    firefox.click("#section")
    wait_for(lambda: visitor.text("hint").startswith("This orbit is"))
    assert len(visitor.starts()) == 9
    assert visitor.text("play") == "Pause"
    visitor.press("as-disk")
    across, down = firefox.middle("#section")
    apart = [[(across + side * d, down) for d in (30, 50, 90)] for side in (-1, 1)]
    firefox.tap("touch", *apart)  # two fingers
    wait_for(lambda: visitor.view().half == pytest.approx(WHOLE * 30 / 90, rel=0.1))
    firefox.tap("touch", [(across, down)])
    wait_for(lambda: len(visitor.starts()) == 10)
    visitor.press("clear")
    visitor.start_at(0.1, 1e-3, 1000)
    expected = BALL.after(BALL.state_xy(0.1, 1e-3, ENERGY), 1000)
    assert visitor.states()[-1].tolist() == np.ravel(expected)[:3].tolist()
    visitor.reload()
    assert visitor.starts() == ["@0.1:0.001"]
    visitor.press("undo")
    visitor.press("undo")
    wait_for(lambda: len(visitor.starts()) == 10)
    assert firefox.errors() == []
