"""The kernel as WebAssembly gives the bits of the one that numba compiles, in real browsers."""

import math

import numpy as np
import pytest

from extensions.explorer import data
from helpers.flights import FAMILIES
from helpers.parts.doubles import bits, digest, packed, unpacked
from helpers.sections import ball_of, sea
from pseudorigid import lyapunov_spectrum, orbit
from pseudorigid.dynamics.variables import chart
from pseudorigid.kernel import arithmetic, closed_forms, formulas, impact
from pseudorigid.kernel.spectrum import push_frame
from study import states

BALL, ENERGY, CHAOTIC = states.BALL, states.ENERGY, states.CHAOTIC
BALLS = [(k, g) for k in (1e-3, 0.012, 0.2, 1.0 / 3.0, 1.0) for g in (1e-8, 1e-4, 0.04, 1.0, 30.0)]
# Applies the map to rows k, g, x, xdot, udot; the last one of a row may be off the section.
STEPS = """
const rows = floats(args[0]), result = new Float64Array(4 * rows.length / 5);
for (let i = 0; i < rows.length / 5; i += 1) {
  const [k, g, ...state] = rows.subarray(5 * i, 5 * i + 5);
  result.set(pseudorigid.iterate(k, g, ...state, 1), 4 * i);
}
return text(result);
"""


def compiled_steps(rows):
    """The next x, xdot, udot and tau of rows k, g, x, xdot, udot."""
    result = np.empty((len(rows), 4))
    for row, out in zip(rows, result, strict=True):
        k, g, *state = row
        out[:] = impact.step(*state, k, g, impact.impact_coefficients(k), None)[:4]
    return result


def assert_same_steps(browser, rows):
    rows = np.array(rows, dtype=float)
    theirs = unpacked(browser.run(STEPS, packed(rows))).reshape(-1, 4)
    ours = compiled_steps(rows)
    differing = np.flatnonzero((bits(ours) != bits(theirs)).any(axis=1))
    assert differing.size == 0, [rows[differing[0]], ours[differing[0]], theirs[differing[0]]]
    return ours


def section_rows(k, g, count, energies):
    """Rows k, g and state of states all over the section of some energies, and on its rim."""
    rows = []
    for energy in energies:
        x, xdot, udot = sea(count, energy, ball_of(k, g))
        s = np.where(np.arange(count) < count // 50, 0.0, xdot + udot)
        y = xdot - k * udot
        xdot, udot = (y + k * s) / (1 + k), (s - y) / (1 + k)
        rows += [(k, g, *state) for state in zip(x, xdot, np.maximum(udot, -xdot), strict=True)]
    return rows


def test_a_million_impacts_of_a_chaotic_orbit(browser):
    """The first ones, whose hash has a block of padding, and the last, which tells all others."""
    start = BALL.start(CHAOTIC, ENERGY)
    ours = orbit(BALL, start, 1_000_000)
    theirs = browser.run(
        """const orbit = Object.entries(pseudorigid.history(0.2, 0.04, ...args, 1e6));
        const hash = values => pseudorigid.sha256(pseudorigid.bytesOf(values.slice(0, 99999)));
        return orbit.map(([name, values]) => [name, hash(values), values.at(-1)]);""",
        *start,
    )
    columns = ((name, ours[name].values) for name in data.STATE)
    assert theirs == [[name, digest(values[:99_999]), values[-1]] for name, values in columns]


def test_starts_over_the_section_also_of_other_balls_and_energies(browser):
    rows = section_rows(0.2, 0.04, 10_000, [ENERGY])
    for k, g in BALLS:
        lowest, bound = closed_forms.energy_bounds(k, g)
        energies = [0.999 * lowest, 0.0, g * g * (1.0 + 0.5 * k), max(bound, 40.0 * g * g)]
        rows += section_rows(k, g, 100, energies)
    assert_same_steps(browser, rows)


def test_flights_beyond_the_narrow_reduction(browser):
    """With little gravity flights last longer than 2^20/omega, which are not computed."""
    random = np.random.default_rng(3)
    rows = [
        (k, 10.0 ** -random.uniform(5.0, 300.0), x, *sorted((-s * random.uniform(0.0, 1.0), s)))
        for k in (0.05, 0.2, 1.0)
        for x in (-0.3, 0.0, 1e-9, 0.4)
        for s in random.uniform(0.001, 1.0, 80)
    ]
    tau = assert_same_steps(browser, rows)[:, 3]
    assert np.sum(np.isnan(tau)) > 500 and np.nanmax(tau) < arithmetic.WIDE


@pytest.mark.parametrize("family", FAMILIES)
def test_flights_that_are_hard_to_compute(browser, family):
    """Near grazing and touches, on the rim, and long ones."""
    random = np.random.default_rng(4)
    assert_same_steps(browser, [family(random) for _ in range(500)])


def test_rest_and_what_is_no_state(browser):
    """NaN, infinities, huge, tiny and subnormal numbers, rest on the floor, and states off it."""
    numbers = (0.0, -0.0, 1.0, -0.3, 5e-324, 1e-310, 1e-160, 1e160, 1e308, math.inf, math.nan)
    rows = [(0.2, 0.04, x, v, w) for x in numbers for v in numbers for w in numbers]
    rows += [(0.2, 0.04, x, 0.0, 0.0) for x in (-1.0, -0.04, -0.04 - 1e-17, -0.03, 0.0, 0.2)]
    rows += [(0.2, g, 0.1 * g, 0.2 * g, 0.3 * g) for g in (1e-320, 1e-200, 1e200, 1e300)]
    assert_same_steps(browser, rows)


@pytest.mark.parametrize("fraction", [-0.23519, CHAOTIC, 0.999])
def test_the_exponent_at_any_number_of_impacts(browser, fraction):
    start = BALL.start(fraction, ENERGY)
    theirs = browser.run(
        """const [impacts, ...state] = args, follower = pseudorigid.follow(0.2, 0.04, ...state);
        follower.advance(1000);
        const early = follower.exponent();
        follower.advance(impacts - 1000);
        const again = pseudorigid.exponent(0.2, 0.04, ...state, impacts);
        return [early, follower.exponent(), again];""",
        *(30_000, *start),
    )
    ours = [
        float(lyapunov_spectrum(BALL, start, impacts, records=1)["exponent"][0, 0])
        for impacts in (1000, 30_000)
    ]
    assert theirs == [*ours, ours[-1]]


def test_a_frame_whose_lengths_leave_the_range_of_doubles(browser):
    """The logarithms are then collected at once; exponents alone would reach it only rarely."""
    start, coefficients = BALL.start(CHAOTIC, ENERGY), impact.impact_coefficients(BALL.k)
    script = """const follower = pseudorigid.follow(0.2, 0.04, ...args.slice(0, 3));
        follower.orbit.set(floats(args[3]), 15);
        follower.advance(1);
        return text(follower.orbit.subarray(6, 21));"""
    x, _, w, _, *flight, _ = impact.step_with_flight(*start, BALL.k, BALL.g, coefficients, None)
    for lengths in ((1e99, 1.0, 1e-99), (1e100, 2.0, 3.0), (1.0, 1e-101, 1.0), (0.0, 1.0, 1.0)):
        frame, sums = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), (3.0, -0.5, 1e-3)
        ours = push_frame(*frame, lengths, sums, BALL.k, BALL.g, coefficients, x, w, *flight)
        theirs = unpacked(browser.run(script, *start, packed([*lengths, *sums])))
        assert bits(sum(ours, ())).tolist() == bits(theirs).tolist()


def test_orbits_that_advance_together(browser):
    """In SIMD lanes, also more orbits than there are lanes, and states that leave their lane."""
    states = np.array(sea(700))
    states[:, 5], states[:, 6] = (0.1, np.nan, 0.1), (0.1, 0.05, -0.05)
    script = """const [x, xdot, udot] = args.slice(1).map(floats);
        const orbits = { x, xdot, udot, tau: new Float64Array(x.length) };
        pseudorigid.iterateMany(0.2, 0.04, orbits, args[0]);
        return Object.values(orbits).map(text);"""
    for impacts in (1, 100):
        theirs = [unpacked(text) for text in browser.run(script, impacts, *map(packed, states))]
        assert np.array_equal(bits(BALL.after(states, impacts)), bits(theirs))


def test_velocities_after_an_impact(browser):
    theirs = browser.run("return pseudorigid.afterImpact(0.2, 0.3, 0.1)")
    assert theirs == [*impact.rebound(0.3, 0.1, 0.2, impact.impact_coefficients(0.2))[:2]]


def test_starts_points_and_the_reversor(browser):
    fractions = np.linspace(-1.0, 1.0, 101).tolist()
    for k, g in BALLS:
        ball = ball_of(k, g)
        for energy in (0.0, 3.0 * g * g):
            starts = np.array(formulas.start(k, g, energy, np.array(fractions))).T
            x, y = chart(k, *sea(101, energy, ball))
            points = np.array(formulas.chart_state(k, g, energy, x, y)).T
            mirrored = np.array(ball.reflect(*points.T)).T
            theirs = browser.run(
                """const [k, g, energy, fractions, xs, ys] = args, all = [[], [], []];
                fractions.forEach((fraction, i) => {
                  all[0].push(...pseudorigid.start(k, g, energy, fraction));
                  const point = pseudorigid.stateXY(k, g, energy, xs[i], ys[i]);
                  all[1].push(...point);
                  all[2].push(...pseudorigid.reverse(k, ...point));
                });
                return all.map(values => text(Float64Array.from(values)));""",
                *(k, g, energy, fractions, x.tolist(), y.tolist()),
            )
            for ours, text in zip((starts, points, mirrored), theirs, strict=True):
                assert np.array_equal(ours.ravel(), unpacked(text)), (k, g, energy)


def test_the_derivative_in_the_chart(browser):
    for fraction in (-0.3, 0.1, 0.5):
        start = BALL.start(fraction, ENERGY)
        script = "return pseudorigid.tangent(0.2, 0.04, ...args)"
        theirs = browser.run(script, *start, 3)
        ours = np.ravel(BALL.chart_jacobian(*start, 3))
        assert np.allclose(theirs, ours, rtol=1e-11, atol=1e-11)


# Calls with a bad argument, and the beginning of the message.
BAD_CALLS = {
    "history(0, 0.04, 0.1, 0.1, 0.1, 5)": "k = 0 is not allowed: 0 < k <= 1",
    "history(0.2, NaN, 0.1, 0.1, 0.1, 5)": "g = NaN is not allowed: g > 0, finite",
    "history(0.2, 0.04, 0.1, -0.2, 0.1, 5)": "a state just before an impact has xdot + udot >= 0",
    "exponent(0.2, 0.04, 0.1, 0.1, 0.1, 0.5)": "impacts = 0.5 is not allowed: a whole number",
    "start(0.2, 0.04, 0.01, 1.5)": "a start is a fraction of the section's radius, from -1 to 1",
    "start(0.2, 0.04, -1, 0.5)": "energy = -1 is not allowed: finite, at least -0.004",
    "stateXY(0.2, 0.04, 0.01, 5, 0)": "no state with this x, y and energy: the point is outside",
}


def test_bad_arguments_are_one_line(browser):
    for call, expected in BAD_CALLS.items():
        script = f"try {{ pseudorigid.{call}; }} catch (e) {{ return [e.name, e.message]; }}"
        name, message = browser.run(script)
        assert name == "RangeError"
        assert message.startswith(expected) and "\n" not in message


def test_variables_with_other_bits_are_named(browser):
    figure = data.published_orbits()[0]
    figure["variables"]["udot"] = "0" * 64
    result = browser.run("return pseudorigid.checkFigure(args[0])", figure)
    assert result == {"impacts": sum(figure["impacts"]), "different": ["udot"]}
