"""The explorer's manners, in Chromium and Firefox: undo, exact starts, words, colours and files."""

import re
import struct
import time
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml
from person import DISK, Visitor
from project import SHIPPED, wait_for
from selenium.webdriver import Keys

from pipeline import config
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import start_state

pytestmark = pytest.mark.slow  # it sees no figure, and takes minutes
BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01


@pytest.fixture
def visitor(either, address):
    either.errors()  # of tests before
    someone = Visitor(either, address)
    someone.open()
    yield someone
    assert either.errors() == []


def test_undo_goes_through_presets_starts_clears_and_parameters(visitor):
    first = visitor.starts()
    assert visitor.run("return document.getElementById('undo').disabled")
    visitor.browser.click("#section")
    wait_for(lambda: len(visitor.starts()) == 9)
    visitor.press("clear")
    assert visitor.starts() == []
    visitor.set("preset", "fig8")
    assert visitor.state()["preset"] == "fig8"
    visitor.set("E-slide", 0.5, 0.45, 0.4, 0.42)
    after = visitor.state()["E"]
    assert after != "0.001"
    visitor.run("document.activeElement.blur()")
    visitor.browser.keys(Keys.CONTROL, "z")  # the whole drag
    wait_for(lambda: visitor.state()["E"] == "0.001")
    assert visitor.state()["preset"] == "fig8" and visitor.value("preset") == "fig8"
    visitor.browser.keys(Keys.CONTROL, "z")
    wait_for(lambda: visitor.starts() == [])
    visitor.run("history.back()")
    wait_for(lambda: len(visitor.starts()) == 9)
    visitor.press("undo")
    wait_for(lambda: visitor.starts() == first)
    assert visitor.state()["preset"] == "fig2"
    assert visitor.run("return document.getElementById('undo').disabled")
    for _ in range(4):
        visitor.run("history.forward()")
        visitor.state()
    assert visitor.state()["E"] == after


def test_a_reload_restores_everything(visitor):
    visitor.press("theme")
    visitor.press("find")
    visitor.set("speed", "6")
    visitor.set("k", "0.25")
    visitor.press("by-verdict")
    shown = (
        "return [document.documentElement.dataset.theme, speed.value,"
        " [...document.querySelectorAll('details[open]')].map(n => n.id), see.textContent,"
        " [...document.querySelectorAll('[aria-pressed]')].map(n => n.ariaPressed)]"
    )
    state, before = visitor.state(), visitor.run(shown)
    visitor.reload()
    assert visitor.state() == state
    assert visitor.run(shown) == before
    assert not visitor.run("return document.getElementById('undo').disabled")
    visitor.press("undo")
    wait_for(lambda: visitor.state()["k"] == "0.2")
    assert visitor.run(shown)[0] == before[0]  # the theme stays
    visitor.press("theme")


@pytest.mark.parametrize(("x", "y"), [(0.4, 0.0), (0.4, 0.1), (-0.1, -0.02), (0.1, 1e-3)])
def test_typed_numbers_start_exactly_there(visitor, x, y):
    visitor.press("clear")
    visitor.set("impacts", "1000")
    visitor.set("start-x", str(x))
    visitor.set("start-y", str(y))
    visitor.run("document.getElementById('start-form').requestSubmit()")
    for _ in range(2):
        visitor.settle()
        _, rows = visitor.table()
        found = np.array([[float(row[n]) for n in ("x", "xdot", "udot")] for row in rows])
        expected = BALL.state_xy(x, y, ENERGY)
        assert found[0].tolist() == [*expected]
        assert found[-1].tolist() == np.ravel(BALL.after(expected, 1000))[:3].tolist()
        assert visitor.starts() == [f"@{x:g}:{y:g}"]
        visitor.reload()  # the address keeps them
    visitor.set("E", "0.008")  # from here on the start is a place
    assert "@" not in visitor.state()["orbits"]


def test_any_click_is_a_scene_that_the_pipeline_takes(visitor, tmp_path):
    """At any k, g and E, pasted into the shipped config, whose variants have other energies."""
    random = np.random.default_rng(7)
    scenes = {}
    for _ in range(12):
        k = random.uniform(0.02, 1.0 / 3.0)
        g = k * random.uniform(0.001, 0.999)
        lowest, bound = Ball(k, g).energy_bounds()
        energy = lowest + (bound - lowest) * random.uniform(0.001, 0.999)
        visitor.open(f"k={k}&g={g}&E={energy}&{DISK}&next=500")
        while not visitor.starts():
            visitor.click_at(*random.uniform(0.1, 0.9, 2))
            time.sleep(0.5)  # a further click at once could be a double one
        visitor.settle()
        for kind in visitor.run(
            "return [...document.getElementById('scene-kind').options].map(o => o.value)"
        ):
            visitor.set("scene-kind", kind)
            visitor.press("copy-scene")
            wait_for(lambda: "config.yaml" in visitor.text("scene-note"))
            scenes |= yaml.safe_load(visitor.value("scene"))
    assert len(scenes) >= 24
    shipped = SHIPPED.read_text(encoding="utf-8")
    head, mark, rest = shipped.partition("\nvariants:")
    assert mark
    pasted = yaml.safe_dump(scenes, default_flow_style=None, sort_keys=False, width=1000)
    lines = "".join(f"  {line}\n" for line in pasted.splitlines())
    (tmp_path / "config.yaml").write_text(f"{head}\n{lines}{mark}{rest}", encoding="utf-8")
    loaded = config.load(tmp_path / "config.yaml").variants["paper"]
    assert set(scenes) <= set(loaded)
    for name, block in scenes.items():
        states = [
            start_state(Ball(**block["ball"]), block["energy"], start) for start in block["starts"]
        ]
        assert np.all(np.isfinite(states)), name


def test_words_under_a_picture_stay_true(visitor):
    figure = visitor.text("see")
    assert "six small ones" in figure
    visitor.set("E-slide", 0.3)
    energy = visitor.state()["E"]
    assert "of your own" in visitor.text("see") and f"E = {energy}" in visitor.text("see")
    assert visitor.value("preset") == ""
    visitor.press("undo")
    wait_for(lambda: visitor.text("see") == figure)
    visitor.browser.click("#section")
    wait_for(lambda: "of your own" in visitor.text("see"))
    visitor.open("thin-shell/fig2")
    assert "Figure 2 of the variant thin-shell, at k = 0.333333" in visitor.text("see")


def test_sixty_orbits_stay_readable(visitor):
    """Regular orbits next to each other differ in hue, and chaotic ones are grey."""
    starts = np.linspace(-0.46, 0.6, 60)
    visitor.open("&".join(["orbits=" + ";".join(f"{p:.4f}*2000" for p in starts), DISK]))
    colours, titles = visitor.run("return [swatches(), titles()]")
    grey = "rgb(134, 134, 134)"
    chaotic = ["chaotic" in title for title in titles]
    assert 5 < sum(chaotic) < 55
    assert [colour == grey for colour in colours] == chaotic
    # Curves around the fixed point cross the line on both of its sides.
    middle = visitor.run("return geometry.fixedPoint(0.2, 0.04, 0.01).x")
    centre, radius = BALL.section(ENERGY)[:2]
    nested = sorted(
        (abs(p - (middle - centre) / radius), colour)
        for p, colour, grey_one in zip(starts, colours, chaotic, strict=True)
        if not grey_one and -0.46 < p < 0.1
    )
    assert len(nested) > 20
    same = [a[1] == b[1] for a, b in pairwise(nested)]
    assert not any(same[:-4])


def test_pictures_say_what_they_show(visitor):
    state = visitor.state()
    hashed = visitor.run("return location.hash")
    width, height = visitor.run(
        "const b = document.getElementById('section').getBoundingClientRect();"
        "return [b.width, b.height].map(Math.round)"
    )
    for name, ratio in (("png2", 2), ("png4", 4)):
        kind, content = visitor.saved(name)
        assert kind == "image/png"
        size = struct.unpack(">II", content[16:24])
        assert size[0] == ratio * width and size[1] > ratio * height
    kind, content = visitor.saved("svg")
    assert kind == "image/svg+xml"
    root = ElementTree.fromstring(content)
    space = "{http://www.w3.org/2000/svg}"
    about = root.find(f"{space}metadata").text
    assert "k = 0.2, g = 0.04, E = 0.01" in about and "pseudorigid" in about
    assert visitor.run("return args[0].endsWith(args[1])", about, hashed)
    texts = "".join(node.text for node in root.iter(f"{space}text"))
    assert "k = 0.2, g = 0.04, E = 0.01" in texts and hashed in texts
    dots = sum(node.get("d").count("h0") for node in root.iter(f"{space}path"))
    impacts = sum(int(part.split("*")[1].strip("!")) for part in state["orbits"].split(";"))
    assert 0.5 * impacts < dots <= impacts  # the surface hides some


def test_csv_of_all_orbits_says_what_they_are(visitor):
    comments, rows = visitor.table("csv-all")
    assert "# k = 0.2, g = 0.04, E = 0.01" in comments
    assert any("explorer.html#k=0.2" in line for line in comments) and len(comments) == 3
    last = [row for row in rows if row["orbit"] == "8"]
    assert len(last) == 25001 and {row["orbit"] for row in rows} == set("12345678")
    expected = BALL.after(BALL.start(0.534522, ENERGY), 25000)
    found = [float(last[-1][name]) for name in ("x", "xdot", "udot", "tau")]
    assert found == np.ravel(expected).tolist()


def test_the_link_the_sources_and_the_variants_are_there(visitor):
    visitor.press("link")
    wait_for(lambda: "link" in visitor.text("record-note"))
    assert visitor.value("address") == visitor.run("return location.href")
    links = visitor.run(
        "return ['paper', 'source', 'citation'].map(n => document.getElementById(n).href)"
    )
    assert "rigid+foundation" in links[0] or "doi.org" in links[0]
    assert links[2].endswith("CITATION.cff")
    assert "Kanso" in visitor.text("cite") and "version" in visitor.text("cite")
    groups = visitor.run(
        "return [...document.querySelectorAll('#preset optgroup')].map(n => n.label)"
    )
    assert "Variant thin-shell" in groups
    visitor.set("preset", "thin-shell/fig8")
    assert visitor.state()["k"].startswith("0.333")


def test_exponents_have_a_logarithmic_axis(visitor):
    offsets, labels = visitor.run(
        "const t = decadesAround(1, Math.log10(25000)); return [t.offsets, t.labels]"
    )
    assert labels == ["10", "100", "1,000", "10,000"]
    assert offsets == pytest.approx([offsets[0] + i for i in range(4)])


def test_the_atlas_shows_a_small_section_at_once(visitor):
    visitor.run("document.getElementById('atlas-panel').open = true; atlas.scrollIntoView()")
    drawn = (
        "await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));"
        "return document.getElementById('peek').toDataURL()"
    )
    seen = []
    for across, down in ((0.5, 0.5), (0.8, 0.2), (0.5, 0.5)):
        visitor.dispatch("pointermove", across, down, "atlas")
        seen.append(visitor.run(drawn))
    assert seen[0] == seen[2] != seen[1]
    visitor.dispatch("pointerleave", 0.5, 0.5, "atlas")
    here = visitor.run(drawn)  # the present place
    assert here not in seen
    visitor.set("k", "0.3")
    assert visitor.run(drawn) != here
    visitor.press("undo")
    wait_for(lambda: visitor.run(drawn) == here)
    assert visitor.state()["k"] == "0.2"


def test_a_double_click_starts_one_orbit(visitor):
    count = len(visitor.starts())
    visitor.dispatch("pointerdown pointerup pointerdown pointerup", 0.5, 0.5)
    assert len(visitor.starts()) == count + 1


def test_a_hint_goes_when_it_is_followed(visitor):
    visitor.click_at(0.02, 0.02)
    assert "outside the section" in visitor.text("hint")
    visitor.click_at(0.5, 0.5)
    assert "outside the section" not in visitor.text("hint")


def test_the_length_shown_is_the_one_drawn(visitor):
    visitor.open("flux")
    wait_for(lambda: "24 branches" in visitor.text("branch-note"))
    lengths = {
        part.split(",")[-2]: part.split(",")[-1] for part in visitor.state()["branches"].split(";")
    }
    assert lengths == {"outer": "1.4", "inner": "1"}
    assert visitor.value("branch-length") == lengths[visitor.value("branch-side")]
    assert re.match(r"6h0", visitor.state()["branches"])
    assert "hyperbolic" in visitor.run(
        "const s = document.getElementById('saddle'); return s.options[s.selectedIndex].text"
    )
    visitor.set("branch-length", "0.7")
    visitor.run("document.getElementById('branch-form').requestSubmit()")
    assert visitor.state()["branches"].endswith("outer,0.7")


def test_the_floor_hides_the_undeformed_ball(visitor):
    """Its outline ends at the floor, above the text "u = "."""
    between = visitor.run(
        "const image = new Image(), ball = document.getElementById('ball');"
        "image.src = ball.toDataURL(); await image.decode();"
        "const copy = new OffscreenCanvas(ball.width, 3), pen = copy.getContext('2d');"
        "pen.drawImage(image, 0, 24 - ball.height);"  # rows between the floor and the text
        "return [...pen.getImageData(0, 0, ball.width, 3).data]"
    )
    assert not any(between)
