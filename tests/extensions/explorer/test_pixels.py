"""Orbits of the section in colour, and those that fill a window, are the pipeline's."""

import numpy as np
import pytest

from extensions.atlas.symmetry_line import symmetric_fixed_point
from extensions.explorer import page
from helpers.slowly import slowly
from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.dynamics.regularity import orbit_types
from pseudorigid.kernel.tangents import turns_and_growth

WORKER = ";\n" + "\n".join(map(page.script, page.WORKER[:-1]))  # a directive would be refused
# Follow the orbits of places to their verdicts, like the page.
PIXELS = f"""{WORKER}
const [k, g, energy, places] = args;
const index = Uint32Array.from({{ length: places.length / 2 }}, (_, i) => i);
const first = crowd.begin({{ k, g, energy, places, index }}), verdicts = [...first.verdict];
const place = i => ({{ p: places[2 * i], q: places[2 * i + 1] }});
const states = [...index].map(i => geometry.stateAt(k, g, energy, place(i)));
for (let found = first; found.rest.index.length;) {{
  found = crowd.further({{ k, g, energy, rest: found.rest, done: found.done }});
  found.index.forEach((cell, i) => {{ verdicts[cell] = found.verdict[i]; }});
}}
return [states, [...first.exponent], [...first.rotation], verdicts.map(v => VERDICTS[v])];"""
FILL = f"""{WORKER}
const [k, g, energy, places, window] = args;
const orbits = crowd.fill({{ k, g, energy, places, window }});
return orbits.map(({{ x, facts }}) => [[...x], facts.verdict]);"""


TYPES = f"""{WORKER}
const [k, g, energy, states] = args;
return states.map((state) => new analysis.Follower(k, g, energy, state).facts().verdict);"""


@pytest.mark.parametrize(("k", "g", "energy"), [(0.2, 0.04, 0.001), (1 / 3, 0.05, 0.003)])
def test_orbits_get_the_words_of_python(browser, k, g, energy):
    """Also on the symmetry line, at the fixed point, along the rim, and on it."""
    ball = Ball(k, g)
    across, up = np.random.default_rng(9).uniform(-0.7, 0.7, (2, 30))
    centre, radius = ball.section(energy)
    height = radius * np.sqrt(k * (1.0 + k))
    x, xdot, udot = ball.state_xy(centre + radius * across, height * up, energy)
    place, _ = symmetric_fixed_point(ball, energy)
    line = ball.start([-0.4, 0.1, 0.3493, 0.7, place, 0.9999999, 1.0], energy)
    states = np.hstack([[x, xdot, udot], line])
    words = browser.run(TYPES, k, g, energy, states.T.tolist())
    assert words == orbit_types(ball, states)
    assert {"regular", "chaotic", "undefined"} <= {*words}


@pytest.mark.parametrize(
    ("k", "g", "energy"),
    [(0.2, 0.04, 0.01), (1 / 3, 0.1, 0.03), *slowly((0.2, 0.04, 0.001))],
)
def test_pixels_have_the_pipeline_s_exponents_rotation_numbers_and_verdicts(browser, k, g, energy):
    places = np.random.default_rng(5).uniform(-0.7, 0.7, (100, 2))
    # Along the rim, where a turn takes long, and where the growth is near the threshold.
    places[:4] = [0.9999999, 0], [0.175555, -0.033553], [-0.05841, 0.32319], [-0.360426, -0.503227]
    states, *found = browser.run(PIXELS, k, g, energy, places.ravel().tolist())
    ball, states = Ball(k, g), np.array(states).T
    exponents, rotations, verdicts = found
    expected = [float(lyapunov_spectrum(ball, s, 200, 1)["exponent"][0, 0]) for s in states.T]
    assert exponents == expected
    types = orbit_types(ball, states)
    # A pixel has a short form of the rule, which ends after 2,000 impacts.
    assert np.mean(np.array(verdicts) == np.array(types)) >= 0.97
    unit, (place, turn) = Ball.dimensionless(k), symmetric_fixed_point(ball, energy)
    centre, radius = unit.section(energy / g**2)[:2]
    around = np.full(100, centre + radius * place), np.full(100, turn)
    regular = np.array(types) == "regular"
    turns = turns_and_growth(k, states / g, *around, 200)[0]
    assert regular.sum() > 5
    assert np.allclose(np.array(rotations)[regular], turns[regular], rtol=0, atol=1e-9)


def test_an_orbit_that_fills_a_window_has_all_its_impacts_there(browser):
    """Islands return until their curve is drawn; an orbit of the sea is not followed further."""
    ball, energy = Ball(0.2, 0.04), 0.01
    centre, radius = ball.section(energy)[:2]
    window = {"x": [centre - radius, centre], "y": [-0.05, 0.05]}
    places = [-0.4, 0], [0.534522, 0], [-0.326707, 0.552701]  # the last one looks regular at first
    found = browser.run(FILL, 0.2, 0.04, energy, places, window)
    (island, sea, _), verdicts = zip(*found, strict=True)
    assert verdicts == ("regular", "chaotic", "chaotic")
    for found, fraction, impacts in ((island, -0.4, 10_000), (sea, 0.534522, 2000)):
        start = ball.start(fraction, energy)
        x, xdot, udot, _ = ball.history(start, impacts)[0].T
        inside = (window["x"][0] <= x) & (x <= window["x"][1]) & (abs(xdot - ball.k * udot) <= 0.05)
        assert found == [start[0], *x[inside]][: len(found)]
        assert fraction < 0 or len(found) == inside.sum() + 1
    assert len(island) > 800
