"""The page's state is in its address, and numbers are read and refused as Python does."""

from fractions import Fraction

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.dynamics.bounds import energy_mistake

BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
BALLS = [(0.2, 0.04, 0.01), (1 / 3, 0.05, 0.003), (0.9, 0.3, -0.04), (0.1, 0.001, 0.048)]


def any_state(random):
    """A state of the page, all fields of which may differ from a fresh one."""

    def one(*values):
        return values[random.integers(len(values))]

    def place():
        return {name: float(random.uniform(-0.7, 0.7)) for name in "pq"}

    def orbit():
        given = {"impacts": int(random.integers(1, 10**7)), "back": one(True, False)}
        return {**place(), "xy": None, **given, "sea": one(True, False)}

    def periodic():
        kind = one("elliptic", "hyperbolic", "inverse hyperbolic")
        return {"period": int(random.integers(1, 13)), "type": kind, "nth": int(random.integers(4))}

    def branch():
        sides = {"kind": one("stable", "unstable", "both"), "side": one("outer", "inner", "both")}
        length = float(random.uniform(0.1, 20))
        return {**periodic(), "saddle": int(random.integers(-1, 24)), **sides, "length": length}

    k, g, energy = one(*BALLS)
    names = ("azimuth", "elevation", "x", "y", "half")
    numbers = [*random.normal(0, 100, 4).tolist(), float(10 ** random.uniform(-9, 1))]
    view = {"kind": one("disk", "surface"), **dict(zip(names, numbers, strict=True))}
    orbits = [orbit(), {**orbit(), "q": 0.0}, {**orbit(), "p": 1e-7}]
    return {
        "k": k, "g": g, "energy": energy, "fill": one(True, False), "jump": one(True, False),
        "view": view, "colour": one("orbit", "verdict", "rotation", "exponent"),
        "orbits": orbits, "map": one("none", "exponent", "rotation", "verdict"),
        "chosen": one(-1, 0, 2),
        "motion": one(None, periodic(), {"period": 0, "type": "near", "nth": 1}),
        "near": [{**place(), "period": int(random.integers(25))}], "periods": [3, 12],
        "branches": [branch(), branch()], "time": float(random.normal(0, 50)),
        "chart": one("exponent", "rotation", "distance", "families"), "span": one(0.5, 1000),
        "twin": one(0, 1e-6), "back": one(True, False), "impacts": one(1, 10**7), "preset": "fig8",
        "panel": one("time", "chart", "orbits", "periodic", "atlas", "export", "help"),
        "tour": one(0, 6), "lesson": one(0, 1, 5), "revealed": one(True, False),
    }  # fmt: skip


def test_an_address_has_the_whole_state(scripts):
    random = np.random.default_rng(1)
    for _ in range(60):
        state = any_state(random)
        script = "const state = { ...freshState(), ...args[0] };"
        script += "return [Object.keys(freshState()), writeAddress(state)]"
        fields, address = scripts.run(script, state)
        found = scripts.run("return readAddress(args[0])", address)
        assert found.pop("leftOut") == 0 and set(state) == set(fields)
        if state["panel"] == "time" and state["chart"] != "exponent":
            assert found.pop("panel") == "chart"  # as in addresses of before, which had no panels
            found["panel"] = "time"
        assert found == state


def test_a_typed_start_keeps_its_point(scripts):
    text = "k=0.2&g=0.04&E=0.01&orbits=@0.1:-0.02*30<;0.25*40!&chosen=9&near=0.1:0.2*6"
    found = scripts.run("return readAddress('#' + args[0])", text)
    typed, other = found["orbits"]
    assert typed["xy"] == [0.1, -0.02] and typed["back"] and not other["back"] and other["sea"]
    centre, radius = BALL.section(ENERGY)
    height = radius * np.sqrt(BALL.k * (1 + BALL.k))
    assert (typed["p"], typed["q"]) == pytest.approx(((0.1 - centre) / radius, -0.02 / height))
    assert found["chosen"] == 1  # the last one
    assert (
        scripts.run("return writeAddress(readAddress(args[0]))", text).count("@0.1:-0.02*30<") == 1
    )


ANSWERS = {
    "orbits=2*10": "it lies outside the section", "orbits=0.5": "a start like 0.5*3000",
    "orbits=0.5*0": "1 to 2000000000", "k=0": "above 0, at most 1", "g=0.3": "below k = 0.2",
    "E=0.07": "below k/2 − g = 0.06", "E=x": "a number is needed", "fig99": "a scene's name",
    "view=cube,1,2,3,4,5": "one of disk, surface", "view=disk,1,2": "a kind and five numbers",
    "view=disk,1,2,3,4,0": "a size above 0", "motion=13e0": "a periodic orbit, like 6e0",
    "motion=0e0": "a periodic orbit", "periods=13": "1 to 12",
    "near=0.9:0.9*6": "a place and a period",
    "near=0:0*25": "a place and a period", "branches=6h0,24,both,both,1": "a saddle's index",
    "branches=6h0,-1,both,both,21": "a length up to 20", "span=1001": "above 0",
    "span=0": "above 0",
    "twin=1": "below 1", "next=10000001": "1 to 10000000", "tour=7": "from 1 to 6",
    "lesson=6": "from 1 to 5", "colour=red": "one of orbit", "panel=x": "one of time",
    "z=1": "no such field",
}  # fmt: skip


def test_a_wrong_address_is_refused_in_a_line_that_names_it(scripts):
    for text, allowed in ANSWERS.items():
        script = "try { readAddress(args[0]); } catch ({ message }) { return message; }"
        message = scripts.run(script, text)
        assert message and message.startswith("the address has ") and allowed in message, text


def test_the_page_allows_the_energies_that_config_yaml_does(scripts):
    """Also where k/2 - g is not a double: 0.2/2 - 0.04 is a little larger than 0.06."""
    balls = [(k / 100, g / 1000) for k in (7, 20, 30, 33, 50, 100) for g in (1, 23, 40, 69)]
    balls += [(1 / 3, 0.05), (1 / 3, 0.1)]
    rows = []
    for k, g in balls:
        high, low = k / 2 - g, -g * g / (2 * k)
        for energy in (high, low, high - 1e-9, high + 1e-9, low - 1e-9, low + 1e-9, 0.0):
            rows.append((k, g, float(f"{energy:.12g}")))
    script = "return args[0].map(([k, g, E]) => [ballAllowed({ k, g, E }),"
    script += " parameterError('E', String(E), { k, g, E: 0 }) === ''])"
    for row, found in zip(rows, scripts.run(script, rows), strict=True):
        assert found == [energy_mistake(*row) == ""] * 2, row


def test_the_ends_that_a_message_names_are_allowed_and_what_lies_beyond_is_not(scripts):
    for k, g, energy in BALLS:
        ball = {"k": k, "g": g, "E": energy}
        for name in ball:
            script = "const [name, ball] = args; return rangeOf(name, ball).map((end, i) =>"
            script += " [end, readNumber(inside(end, i ? -1 : 1))])"
            for (end, shown), sign in zip(scripts.run(script, name, ball), (1, -1), strict=True):
                assert -1e-15 <= sign * (shown - end) <= 1e-3 * abs(end)
                step = sign * 1e-6 * max(abs(end), 1e-3)
                for value, allowed in ((shown + step, True), (end - step, False)):
                    script = "return parameterError(args[0], String(args[1]), args[2])"
                    error = scripts.run(script, name, value, ball)
                    assert (error == "") == allowed, (name, value, error)


def test_numbers_are_read_as_people_write_them(scripts):
    read = "return args.map(readNumber)"
    for text in ("1/3", " 2 / 7 ", "0,25", "−1.5e-3", "+.5", "7.", "1e5"):
        value = Fraction(text.replace("−", "-").replace(",", ".").replace(" ", "").rstrip("."))
        assert scripts.run(read, text) == [float(value)]
    assert scripts.run(read, "", "1/0", "1e", "x", "1 2", "0x10", "1e999") == [None] * 7
    counts = scripts.run("return args.map(readCount)", "3000", "12,000", "2.000", "1,00", "1e3")
    assert counts == [3000, 12000, None, None, 1000]
    shown = scripts.run(
        "return [[-0.000123456789, 3], [1/3, 6], [NaN, 6]].map(a => shortNumber(...a))"
    )
    assert shown == ["−0.000123", "0.333333", "–"]
