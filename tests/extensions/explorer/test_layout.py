"""The page fits into one window: boxes of what one turns and sees, also in tour and questions."""

import json

import pytest

from extensions.explorer import page
from helpers.parts.person import DISK
from helpers.project import wait_for

pytestmark = pytest.mark.slow  # it sees no figure
# What a browser's bars leave: width, height, and the least height of the section.
WINDOWS = [(1280, 680, 400), (1024, 640, 320), (390, 664, 260)]
# The ids of controls and charts that a step of the tour names.
NAMED = [["play", "section"], ["section"], ["section"], ["chart"], ["section"], ["play-energy"]]
TOUR, LESSON = (
    json.loads((page.WEB / f"{name}.json").read_text("utf-8")) for name in ("tour", "lesson")
)
BOXES = """return Object.fromEntries(args[0].map(id => {
  const b = document.getElementById(id).getBoundingClientRect();
  return [id, [b.left, b.top, b.right, b.bottom]]; }))"""
SIZE = "return [innerWidth, innerHeight, document.scrollingElement.scrollHeight]"


@pytest.fixture
def window(person):
    """A function that opens an address in a window of a size."""

    def show(width, height, address=""):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500}
        person.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
        person.open(address)
        return person

    yield show
    person.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def boxes(person, names):
    """The boxes [left, top, right, bottom] of elements, all of them in the window."""
    found = person.run(BOXES, names)
    wide, tall, whole = person.run(SIZE)
    assert whole <= tall
    for name, (left, top, right, bottom) in found.items():
        assert right > left and bottom > top, f"{name} is not shown"
        assert left >= 0 and top >= 0 and right <= wide and bottom <= tall, name
    return found


@pytest.mark.parametrize(("width", "height", "least"), WINDOWS)
def test_one_window_has_the_section_the_ball_and_what_one_turns(window, width, height, least):
    person = window(width, height)
    names = ["section", "ball", "play", "map", "play-energy", "tour-start", "lesson-start", "hint"]
    values = [f"{name}{part}" for name in ("E", "k", "g") for part in ("", "-slide")]
    tabs = ["time", "chart", "orbits", "periodic", "atlas", "export", "help"]
    found = boxes(person, [*names, *values, "curves", *(f"tab-{name}" for name in tabs)])
    size = {
        name: (right - left, bottom - top) for name, (left, top, right, bottom) in found.items()
    }
    assert size["section"][1] >= least and size["section"][0] >= least
    assert min(size["ball"]) >= 120
    assert size["E-slide"][0] >= 160
    assert found["E-slide"][3] <= found["k-slide"][1]  # a row of its own, above k and g
    assert found["k"][2] <= found["g-slide"][0] and abs(found["k"][1] - found["g"][1]) < 1
    header = person.run(BOXES.replace("getElementById", "querySelector"), ["header"])["header"]
    assert header[3] - header[1] < 2 * size["tour-start"][1]
    person.press("tab-chart")
    chart = boxes(person, ["section", "ball", "chart", "E-slide"])
    assert chart["section"] == found["section"]
    assert not person.find("curves").is_displayed()


@pytest.mark.parametrize(("width", "height"), [*(size[:2] for size in WINDOWS), (1366, 768)])
def test_the_tour_and_the_questions_keep_what_they_name_in_the_window(window, width, height):
    for number, (step, named) in enumerate(zip(TOUR, NAMED, strict=True), 1):
        person = window(width, height, f"{step['address']}&tour={number}")
        found = boxes(person, [*named, "guide-text", "guide-next", "section", "ball", "E-slide"])
        assert found["section"][3] - found["section"][1] >= 260
        assert person.text("guide-text") == step["text"] and person.text("hint") == ""
        words = {"play": "Press Play:", "chart": "chart", "play-energy": "Play E"}
        assert all(word in step["text"] for name, word in words.items() if name in named)
    for number, step in enumerate(LESSON, 1):
        for revealed in ("", "&revealed=1"):
            address = step["reveal"] if revealed else step["address"]
            person = window(width, height, f"{address}&lesson={number}{revealed}")
            tried = [] if revealed else ["reveal", "choices" if "choices" in step else "guess"]
            chart = ["chart"] if "panel=chart" in address else []
            boxes(person, [*tried, *chart, "guide-text", "section", "ball", "E-slide", "play"])


def test_panels_open_by_click_and_keys_and_the_link_keeps_them(person):
    person.open(DISK)
    person.press("tab-orbits")
    assert person.state()["panel"] == "orbits" and person.find("orbits").is_displayed()
    person.find("tab-orbits").send_keys("\ue014")  # arrow to the right
    assert person.state()["panel"] == "periodic"
    person.reload()
    assert person.find("find").is_displayed()
    person.press("tab-periodic")  # a second click shows the time again
    assert "panel" not in person.state() and person.find("curves").is_displayed()
    person.open(f"{DISK}&chart=rotation")  # an older address
    assert person.find("chart").is_displayed()


def test_at_the_start_a_ball_bounces_and_a_sentence_asks(person):
    person.browser.open("about:blank")
    person.browser.open(person.file)
    wait_for(lambda: person.text("play") == "Pause")
    assert person.text("hint").count("?") == 1
    wait_for(lambda: "t = 0.00" not in person.text("moment"))
    media = {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]}
    person.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", media)
    person.browser.open("about:blank")
    person.browser.open(person.file)
    wait_for(lambda: "t = 0.00" in person.text("moment"))
    assert person.text("play") == "Play"
    person.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_large_type_is_large_and_kept(person):
    size = "return parseFloat(getComputedStyle(document.getElementById('hint')).fontSize)"
    before = person.run(size)
    person.press("large")
    assert person.run(size) > 1.3 * before
    person.reload()
    assert person.run(size) > 1.3 * before
    person.press("large")
    assert person.run(size) == before
