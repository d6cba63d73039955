"""What fields and sliders of the explorer say is what the picture shows."""

from fractions import Fraction

import pytest
from selenium.webdriver import Keys

from helpers.project import wait_for

pytestmark = pytest.mark.slow  # it sees no figure
FIELDS = ("k", "g", "E")
BALLS = ["fig8", "k=0.9&g=0.3&E=-0.04", "k=0.1&g=0.001&E=0.048"]


def shown(person):
    """The numbers in the fields, which are those of the address."""
    fields = [float(person.value(name)) for name in FIELDS]
    state = person.state()
    assert [float(state[name]) for name in FIELDS] == fields
    return fields


@pytest.mark.parametrize("where", BALLS)
def test_no_slider_reaches_a_refused_value(person, where):
    person.open(where)
    for name in FIELDS:
        low, high = person.run(
            "const s = document.getElementById(args[0]); return [s.min, s.max].map(Number)",
            f"{name}-slide",
        )
        for share in (0.0, 0.02, 0.3, 0.5, 0.9, 1.0):
            person.set(f"{name}-slide", low + share * (high - low))
            k, g, energy = shown(person)
            assert person.text(f"{name}-error") == ""
            assert 0 < g < k <= 1 and -g * g / (2 * k) < energy < k / 2 - g


@pytest.mark.parametrize(("name", "text", "words"), [
    ("g", "0.174", "above 0, below 0.09 at k = 0.2 and E = 0.01"),
    ("g", "0.3", "above 0, below k = 0.2"),
    ("k", "0.09", "above 0.1, at most 1 at g = 0.04 and E = 0.01"),
    ("k", "0", "k = 0 is not allowed"),
    ("k", "", "k = nothing is not allowed"),
    ("k", "1/0", "a number"),
    ("E", "1e", "a number"),
    ("E", "-1", "above −g²/2k = −0.004, below k/2 − g = 0.06, eq. (31)"),
    ("impacts", "0", "whole number"),
    ("E", "0.061", "below k/2 − g = 0.06, eq. (31)"),
    ("impacts", "20000000", "a whole number from 1 to"),
    ("impacts", "2.000", "a whole number from 1 to"),
    ("impacts", " ", "impacts = nothing is not allowed"),
])  # fmt: skip
def test_a_refused_value_leaves_the_field_and_says_why(person, name, text, words):
    before = person.value(name)
    person.type(name, text)
    assert words in person.text(f"{name}-error") and "\n" not in person.text(f"{name}-error")
    assert person.find(name).get_attribute("aria-invalid") == "true"
    person.browser.click("#section")  # the orbit starts at what the field says then
    assert person.value(name) == before and shown(person) == [0.2, 0.04, 0.01]
    error = person.text(f"{name}-error")
    assert f"{name} = {text.strip() or 'nothing'} is not allowed" in error and error.endswith(
        f"stays {before}."
    )
    assert person.state()["orbits"].endswith("*3000")
    seen = "const b = document.getElementById(args[0]).getBoundingClientRect();"
    seen += "return b.top >= 0 && b.bottom <= innerHeight"
    person.run("document.getElementById(args[0]).scrollIntoView({block: 'center'})", name)
    assert person.run(seen, f"{name}-error")
    person.type(name, before + Keys.TAB)
    assert person.text(f"{name}-error") == ""


@pytest.mark.parametrize("text", ["1/3", " 2 / 7 ", "0,25", "3e-1/1"])
def test_every_number_field_takes_fractions(person, text):
    value = float(Fraction(text.replace(" ", "").replace(",", "."))) if "e" not in text else 0.3
    person.set("k", text)
    wait_for(lambda: person.state()["k"] == repr(value))
    person.press("clear")
    person.start_at("1/7", "-1/50", 30)
    assert person.starts() == [f"@{1 / 7!r}:{-1 / 50!r}"]
    for name in ("fan-from", "fan-to"):
        person.set(name, "1/4" if name == "fan-to" else "-1/4")
    person.set("fan-count", "4/2")
    person.run("document.getElementById('fan-form').requestSubmit()")
    assert [float(start) for start in person.starts()[1:]] == [-0.25, 0.25]
    assert "A row of 2 orbits" in person.text("hint")  # no orbit of it takes its place
