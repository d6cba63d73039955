"""What colours, titles and answers of the explorer mean: each one thing, which is true."""

import json
import re
from itertools import product
from math import atan2, cos, degrees, exp, hypot, radians, sin, sqrt

import numpy as np
import pytest

from extensions.atlas.symmetry_line import symmetric_fixed_point
from extensions.explorer import page
from helpers.colours import lab
from helpers.parts.person import DISK
from helpers.project import wait_for
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import of_type

BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
LESSON = json.loads((page.WEB / "lesson.json").read_text("utf-8"))
VERDICTS = ["regular", "chaotic", "undecided", "regular-orbit", "chaotic-orbit"]
LINES = ["stable", "unstable", "jump", "elliptic", "hyperbolic", "sea"]
LINES += [f"hue{n}" for n in range(7)]


def ciede2000(one, other):
    """The colour difference of Sharma, Wu and Dalal (2005) between CIELAB colours."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    mean = ((hypot(a1, b1) + hypot(a2, b2)) / 2) ** 7
    grown = 1.5 - 0.5 * sqrt(mean / (mean + 25**7))
    a1, a2 = a1 * grown, a2 * grown
    c1, c2 = hypot(a1, b1), hypot(a2, b2)
    h1, h2 = degrees(atan2(b1, a1)) % 360, degrees(atan2(b2, a2)) % 360
    turn = (h2 - h1 + 180) % 360 - 180 if c1 * c2 else 0.0
    hue = 2 * sqrt(c1 * c2) * sin(radians(turn / 2))
    at = h1 + turn / 2 if c1 * c2 else h1 + h2
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    parts = [(0.17, 1, -30), (-0.24, 2, 0), (-0.32, 3, 6), (0.2, 4, -63)]
    t = 1 - sum(size * cos(radians(n * at + shift)) for size, n, shift in parts)
    by_light = 1 + 0.015 * (light - 50) ** 2 / sqrt(20 + (light - 50) ** 2)
    by_chroma, by_hue = 1 + 0.045 * chroma, 1 + 0.015 * chroma * t
    twist = 2 * sqrt(chroma**7 / (chroma**7 + 25**7))
    twist *= sin(radians(60 * exp(-(((at % 360 - 275) / 25) ** 2))))
    x, y, z = (l2 - l1) / by_light, (c2 - c1) / by_chroma, hue / by_hue
    return sqrt(x * x + y * y + z * z - twist * y * z)


def test_the_colour_difference_is_that_of_the_published_examples():
    for one, other, expected in (
        ((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
        ((50, -1.3802, -84.2814), (50, 0, -82.7485), 1.0000),
        ((50, 2.5, 0), (50, 0, -2.5), 4.3065),
        ((50, 2.5, 0), (73, 25, -18), 27.1492),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((22.7233, 20.0904, -46.6940), (23.0331, 14.9730, -42.5619), 2.0373),
    ):
        assert ciede2000(one, other) == pytest.approx(expected, abs=5e-5)


def palettes():
    """The colours of the style sheet by name, in the light and in the dark theme."""
    style = (page.WEB / "style.css").read_text("utf-8")
    blocks = style.split("}")[:2]
    return [dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6});", block)) for block in blocks]


def luminance(color):
    """The relative luminance of WCAG 2."""
    part = np.array([*bytes.fromhex(color[1:])]) / 255
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


@pytest.mark.parametrize("theme", [0, 1], ids=["light", "dark"])
def test_lines_and_orbits_have_no_colour_of_a_verdict(theme):
    colour = palettes()[theme]
    for vision, verdict, line in product(("normal", "deuteranopia"), VERDICTS, LINES):
        apart = ciede2000(lab(colour[verdict], vision), lab(colour[line], vision))
        assert apart >= 15, (vision, verdict, line)
    for vision in ("normal", "deuteranopia"):
        fills = [lab(colour[name], vision) for name in (*VERDICTS[:3], "surface")]
        for i, one in enumerate(fills):
            assert all(ciede2000(one, other) >= 10 for other in fills[i + 1 :])
    for line in {*LINES, *VERDICTS[3:]} - {"sea"}:  # lines are seen on any fill
        for fill in ("surface", *(VERDICTS[:3] if line in LINES else [])):
            dark, light = sorted(luminance(colour[name]) for name in (line, fill))
            assert (light + 0.05) / (dark + 0.05) >= 3, (line, fill)


def test_the_answers_of_the_questions_are_true():
    """By Python; what pictures show is tested where they are drawn."""
    growing, islands, apart, repeats, energies = LESSON
    parts = re.findall(r"([-\d.]+)\*12", growing["address"])
    fractions = [*map(float, parts)]
    assert len(fractions) == len(growing["choices"]) == 3
    wide = []
    for fraction in fractions:
        x, *_ = BALL.history(BALL.start(fraction, ENERGY), 20000)[0].T
        wide.append(len(np.unique(np.round(x, 2))))
    assert np.argmax(wide) == growing["answer"] and "Start 3" in growing["why"]
    turns = [symmetric_fixed_point(BALL, islands["answer"][end])[1] for end in ("from", "to")]
    assert min(turns) < 1 / 6 < max(turns)
    assert f"{0.0073785:.7f}" in islands["why"]
    assert symmetric_fixed_point(BALL, 0.0073785)[1] == pytest.approx(1 / 6, abs=1e-6)
    one = np.array(BALL.start(0.534522, ENERGY))
    other = BALL.state_xy(one[0] + 1e-6, one[1] - BALL.k * one[2], ENERGY)
    x, xdot, udot, _ = (BALL.history(other, 30)[0] - BALL.history(tuple(one), 30)[0])[-1]
    distance = np.hypot(x, (xdot - BALL.k * udot) / np.sqrt(BALL.k * (1 + BALL.k)))
    assert apart["choices"][apart["answer"]] == f"{distance:.1g} R" == "0.008 R"
    period = of_type(symmetric_orbits(BALL, ENERGY, 6), "elliptic").sizes["point"]
    assert repeats["answer"] == {"from": period, "to": period}
    assert energies["choices"][energies["answer"]] == "It grows again"


@pytest.mark.slow  # it sees no figure
def test_questions_are_tried_and_revealed_and_have_links(person):
    person.press("lesson-start")
    for number, step in enumerate(LESSON, 1):
        assert person.text("guide-title") == f"{number} of 5. {step['title']}"
        if "choices" in step:
            wrong = next(i for i in range(len(step["choices"])) if i != step["answer"])
            press = "document.querySelectorAll('#choices button')[args[0]].click()"
            person.run(press, wrong)
            assert person.text("guide-text").startswith("No, that is not it.")
            person.run(press, step["answer"])
        else:
            right = step["answer"]["to"]
            for guess, words in (("", "Type a number."), ("9", "No, that"), (right, "Right.")):
                person.run("document.getElementById('guess').value = args[0]", guess)
                person.press("answer")
                assert person.text("guide-text").startswith(words)
        assert person.text("guide-text") == f"Right. {step['why']}"
        state = person.state()
        assert (state["lesson"], state["revealed"]) == (str(number), "1")
        person.press("guide-link")
        link = person.value("address").split("#")[1]
        person.press("undo")
        wait_for(lambda: person.find("reveal").is_displayed())
        person.press("reveal")
        assert person.text("guide-text") == step["why"]
        person.open(link)  # a teacher's
        assert person.text("guide-text") == step["text"]
        assert person.find("reveal").is_displayed()
        person.press("guide-next")
    assert not person.find("guide").is_displayed()


@pytest.mark.slow  # it sees no figure
def test_the_share_of_regular_motion_grows_as_a_question_says(person):
    shares = []
    for step in (LESSON[4]["address"], LESSON[4]["reveal"]):
        person.open(step)
        wait_for(lambda: "200 × 200 cells" in person.text("map-note"))
        shares.append(float(re.search(r"regular ([\d.]+) %", person.text("map-note"))[1]))
    assert shares == pytest.approx([3, 15], abs=0.9)


@pytest.mark.slow  # it sees no figure
def test_shares_are_of_what_is_decided(person):
    person.open(f"{DISK}&E=0.0015&map=verdict")
    notes = []

    def complete():
        notes.append(person.text("map-note"))
        return "200 × 200" in notes[-1]

    wait_for(complete, 120)
    assert not any("regular 0.0 %" in text and "100.0 % decided" in text for text in notes)
    assert all("decided" in text or "preview" in text for text in notes if text)
    shares = re.findall(r"(?:regular|chaotic|undecided) ([\d.]+) %", notes[-1])
    regular, chaotic, undecided = map(float, shares)
    assert regular + chaotic + undecided == pytest.approx(100, abs=0.2)
    assert regular > 50


@pytest.mark.slow  # it sees no figure
def test_titles_show_what_they_name(person):
    options = "return [...document.querySelectorAll(args[0])].map(o => [o.value, o.textContent])"
    charts = {"exponent": "Lyapunov exponents", "rotation": "otation number"}
    for name, title in person.run(options, "#preset option")[1:]:
        assert "_" not in title and title != name
        person.set("preset", name)
        chart = next((kind for kind, words in charts.items() if words in title), None)
        if chart:
            assert person.find("chart").is_displayed() and person.value("chart-kind") == chart
    person.set("preset", "fig2")
    names = [text for _, text in person.run(options, "#variant option")]
    assert "Lower energy" in names and not any("-" in name for name in names)


@pytest.mark.slow  # it sees no figure
def test_limits_are_accepted_and_a_chaotic_orbit_has_no_rotation_number(person):
    person.open(f"k=1/3&g=0.05&E=0.003&{DISK}&orbits=0.5*3000;-0.2*3000&periods=1")
    low, high = re.findall(r"[−\d.]+", person.text("bounds"))[:2]
    for limit in (low, high):
        person.set("E", limit)
        assert person.text("E-error") == ""
        assert person.state()["E"] == str(float(limit.replace("−", "-")))
    person.set("E", "0.1167")
    assert "below k/2 − g = 0.1166" in person.text("E-error")
    person.open(f"{DISK}&orbits=0.534522*3000;-0.2*3000&periods=1")
    chaotic, regular = person.settled()
    assert (chaotic["verdict"], chaotic["rotation"]) == ("chaotic", "–")
    assert (regular["verdict"], float(regular["rotation"]) > 0.1) == ("regular", True)
    wait_for(lambda: person.text("periodic-note").startswith("1 symmetric orbit."))
