"""Where the page draws states, in the section, in time and in colour, is where Python has them."""

import numpy as np
import pytest

from extensions.atlas.symmetry_line import symmetric_fixed_point
from helpers.parts.engine import PROJECTED
from pseudorigid import Ball, lyapunov_spectrum, symmetric_orbits
from pseudorigid.kernel.tangents import turns_and_growth

BALL, ENERGY = Ball(k=0.2, g=0.04), 0.01
BALLS = [(0.2, 0.04, 0.01), (1 / 3, 0.05, 0.003), (0.9, 0.3, -0.04), (0.1, 0.001, 0.048)]


@pytest.mark.parametrize(("k", "g", "energy"), BALLS)
def test_the_section_and_its_starts_are_python_s(scripts, k, g, energy):
    ball = Ball(k, g)
    centre, radius = ball.section(energy)
    height = radius * np.sqrt(k * (1 + k))
    found = scripts.run("return geometry.section(...args)", k, g, energy)
    assert list(found.values()) == pytest.approx([centre, radius, height], rel=1e-15)
    for p, q in [(0.3, 0.0), (-0.99, 0.0), (0.4, -0.5), (-0.7, 0.7)]:
        script = (
            "const [k, g, energy, p, q] = args; const s = geometry.stateAt(k, g, energy, { p, q });"
        )
        script += "const { x, y } = geometry.pointAt(k, g, energy, p, q);"
        script += "return [s, [x, y], geometry.placeAt(k, g, energy, x, y)]"
        state, (x, y), back = scripts.run(script, k, g, energy, p, q)
        expected = ball.start(p, energy) if q == 0 else ball.state_xy(x, y, energy)
        assert state == [*map(float, expected)]
        assert (x, y) == pytest.approx((centre + p * radius, q * height), rel=1e-15)
        assert back == pytest.approx([p, q], rel=1e-13, abs=1e-14)
    script = "return [[0.8, 0.7], [1, 0]].map(([p, q]) => geometry.stateAt(...args, { p, q }))"
    assert scripts.run(script, k, g, energy) == [None, None]
    fixed = scripts.run("return geometry.fixedPoint(...args)", k, g, energy)
    place, turn = symmetric_fixed_point(ball, energy)
    assert fixed["p"] == pytest.approx(place, abs=1e-9)
    assert (fixed["rotation"] or np.nan) == pytest.approx(turn, abs=1e-9, nan_ok=True)
    assert fixed["x"] == pytest.approx(centre + place * radius, abs=1e-12)
    jump = scripts.run("return geometry.firstJump(...args)", k, g)
    assert jump == pytest.approx(g * g * (1 + k / 2))


@pytest.mark.parametrize("view", [
    ("disk", 115, 40, 0, 0, 1.12), ("disk", 115, 40, 0.2, -0.3, 0.1),
    ("surface", 115, 40, 0, 0, 1.12), ("surface", 30, -20, 0, 0, 1.12),
    ("surface", 270, 90, 0.1, 0.05, 0.3),
])  # fmt: skip
def test_a_point_of_the_screen_is_the_place_that_is_drawn_there(scripts, view):
    view = dict(zip(("kind", "azimuth", "elevation", "x", "y", "half"), view, strict=True))
    places = (np.random.default_rng(2).uniform(-0.7, 0.7, (200, 2))).tolist()
    if view["kind"] == "disk":
        places += [[0, 0.98], [0, -0.98], [0.98, 0], [-0.98, 0]]
    state = {"k": 0.2, "g": 0.04, "energy": 0.01, "view": view}
    window, rows = scripts.run(PROJECTED, state, places)
    seen = [(place, *row) for place, row in zip(places, rows, strict=True) if row]
    assert len(seen) > 60 and (view["half"] < 1 or all(inside for _, inside, *_ in seen))
    for (p, q), inside, _, back in seen:
        assert back == pytest.approx([p, q], abs=1e-9)
        within = all(window[name][0] <= v <= window[name][1] for name, v in (("p", p), ("q", q)))
        assert within or not inside
    if view["kind"] == "disk":  # x to the right, y upwards, with one scale
        across, down = np.array([at for _, _, at, _ in seen]).T
        p, q = np.array([place for place, *_ in seen]).T
        assert np.polyfit(p, across, 1)[0] == pytest.approx(-np.polyfit(q, down, 1)[0])


def test_ticks_lie_at_round_numbers_within_their_span(scripts):
    for centre, span, count in [(0.1, 1.0, 5), (-3.0, 0.02, 4), (0.25, 1e-11, 4), (1e4, 50, 8)]:
        script = "const t = ticksAround(...args);"
        script += "return [t.offsets, t.labels.map(readNumber), t.base && readNumber(t.base)]"
        offsets, labels, base = scripts.run(script, centre, span, count)
        assert 2 <= len(offsets) <= count + 2 and np.max(np.abs(offsets)) < 0.501 * span
        step = np.diff(offsets)
        assert np.allclose(step, step[0])
        assert f"{step[0]:.3e}"[0] in "125" and float(f"{step[0]:.0e}") == pytest.approx(step[0])
        assert np.add(labels, base or 0.0) == pytest.approx(
            np.add(centre, offsets), abs=1e-9 * span + 1e-12
        )
        assert (base != "") == (span < 1e-6)


FLIGHTS = """const [kind, extra] = args;
const flown_ = (motion, j) => {
  const { begin, tau, state } = motion.flight(j);
  const ends = [0, tau].map((t) => flown(0.2, 0.04, state, t));
  const found = motion.indexAt(begin + 0.5 * tau);
  return { begin, tau, state, ends, found, impact: motion.impact(j) };
};
let motion;
if (kind === "periodic") motion = new PeriodicMotion({ points: extra, period: extra.length });
else {
  const back = kind === "back";
  const page = { state: { k: 0.2 }, orbits: [] };
  const orbit = new Orbit({ p: 0.3, q: 0, xy: null, impacts: 40, back, sea: false }, page);
  orbit.start = pseudorigid.start(0.2, 0.04, 0.01, 0.3);
  const first = back ? pseudorigid.reverse(0.2, ...orbit.start) : orbit.start;
  const whole = pseudorigid.history(0.2, 0.04, ...first, 40);
  for (const [from, to] of [[0, 15], [15, 40]]) orbit.append({ facts: null,
    ...Object.fromEntries(Object.entries(whole).map(([n, v]) => [n, v.slice(from, to)])) }, 0.2);
  motion = new OrbitMotion(orbit);
}
const [from, to] = kind === "periodic" ? [-4, 9] : [0, motion.count];
const flights = Array.from({ length: to - from }, (_, i) => flown_(motion, from + i));
return [motion.ends, flights];"""


@pytest.mark.parametrize("kind", ["forward", "back", "periodic"])
def test_flights_follow_each_other_from_impact_to_impact(scripts, kind):
    """Each ends in the state in which the next one begins; a backward orbit runs towards t = 0."""
    six = symmetric_orbits(BALL, ENERGY, 6).isel(orbit=0)
    points = np.stack([six[name] for name in ("x", "xdot", "udot", "tau")], axis=1).tolist()
    ends, flights = scripts.run(FLIGHTS, kind, points)
    for i, flight in enumerate(flights):
        x, v, w = flight["state"]
        start, end = flight["ends"]
        assert (start["x"], start["u"]) == pytest.approx((x, -x), abs=1e-14)
        assert end["x"] + end["u"] == pytest.approx(0.0, abs=1e-12)
        assert flight["found"] == i - 4 * (kind == "periodic")
        assert flight["impact"] == i - {"forward": 0, "back": 40, "periodic": 4}[kind]
        if i + 1 < len(flights):
            after = flights[i + 1]
            assert after["begin"] == pytest.approx(flight["begin"] + flight["tau"], abs=1e-11)
            image = np.ravel(BALL.after((x, v, w), 1))
            assert after["state"] == pytest.approx(image[:3], abs=1e-9)
            assert flight["tau"] == pytest.approx(image[3], abs=1e-9)
    if kind == "periodic":
        return
    total = sum(flight["tau"] for flight in flights)
    assert ends == pytest.approx([-total, 0] if kind == "back" else [0, total])
    assert flights[0]["begin"] == pytest.approx(ends[0])


def test_a_ball_in_flight_is_where_eq_26_has_it(scripts):
    x, v, w = BALL.start(0.534522, ENERGY)
    after_v = ((1 - BALL.k) * v - 2 * BALL.k * w) / (1 + BALL.k)
    after_w = (-2 * v - (1 - BALL.k) * w) / (1 + BALL.k)
    for t in (0.0, 0.3, 1.7):
        found = scripts.run("return flown(0.2, 0.04, args[0], args[1])", [x, v, w], t)
        expected = (
            x + after_v * t + BALL.g * t * t / 2,
            -x * np.cos(t) + after_w * np.sin(t),
        )
        assert (found["x"], found["u"]) == pytest.approx(expected, abs=1e-14)


def test_the_time_that_is_shown_is_the_span_around_the_moment(scripts):
    script = """return args.map(([time, span]) =>
      TimeView.prototype.window.call({ read: () => ({ state: { time, span } }) }))"""
    shown = scripts.run(script, [5, 16], [16, 16], [-3, 16], [61, 30])
    assert shown == [[0, 16], [16, 32], [-16, 0], [60, 90]]


def test_the_slope_of_a_growing_distance_is_that_of_a_fit(scripts):
    n = np.arange(30)
    apart = 1e-6 * np.exp(0.23 * n + 0.1 * np.sin(n))
    found = scripts.run("return slope(...args)", np.stack([n, apart], axis=1).tolist(), 1e-4)
    used = apart < 1e-4
    assert 5 < used.sum() < 30
    assert found == pytest.approx(np.polyfit(n[used], np.log(apart[used]), 1)[0])
    assert scripts.run("return slope([[0, 1], [1, 2], [2, 3], [3, 4]], 9)") is None


def test_cells_of_a_grid_cover_the_section_once_and_the_reversor_gives_the_other_half(scripts):
    script = """const [size, window, half] = args;
      const arrays = ({ index, places }) => [[...index], [...places]];
      return new Colouring({ pool: { workers: 3 } }).chunks(size, window, half).map(arrays)"""
    window = {"p": [-1, 1], "q": [-1, 1]}
    for size, half in ((60, False), (60, True), (67, False)):
        parts = scripts.run(script, size, window, half)
        count = [len(part[0]) for part in parts]
        assert len(count) % 3 == 0 and max(count) - min(count) <= 1  # workers have as much to do
        index = np.concatenate([part[0] for part in parts])
        places = np.concatenate([part[1] for part in parts]).reshape(-1, 2)
        assert np.unique(index).size == index.size
        rows, columns = np.divmod(index, size)
        assert (rows.min() == size // 2) == half
        middles = (np.stack([columns, rows], axis=1) + 0.5) * 2 / size - 1
        inside = np.hypot(*middles.T) < 0.99
        assert np.allclose(places[inside], middles[inside]) and np.all(np.hypot(*places.T) < 1)
        every = np.stack(np.meshgrid(*[np.arange(size)] * 2), axis=-1).reshape(-1, 2)
        wanted = np.hypot(*((every + 0.5) * 2 / size - 1).T) < 1
        assert index.size >= wanted.sum() / (2 if half else 1)
    script = """const grid = new Grid(4);
      grid.take({ index: [1, 6], exponent: [0.1, 0.2], verdict: [1, 2] }, args[0]);
      const known = [...grid.known.keys()].filter((i) => grid.known[i]);
      return [known, grid.exponent[13], grid.verdict[10]]"""
    known, exponent, verdict = scripts.run(script, True)
    assert known == [1, 6, 10, 13] and (exponent, verdict) == (pytest.approx(0.1), 2)
    assert scripts.run(script, False) == [[1, 6], 0, 0]


def test_cells_have_python_s_rotation_numbers_and_exponents(scripts):
    places = [(-0.4, 0.0), (-0.3, 0.1), (-0.1, -0.05), (-0.2, 0.02)]  # of regular orbits
    script = """const index = Uint32Array.from(args[0], (_, i) => i), places = args[0].flat();
      const at = ([p, q]) => geometry.stateAt(0.2, 0.04, 0.01, { p, q });
      const found = crowd.begin({ k: 0.2, g: 0.04, energy: 0.01, places, index });
      return [args[0].map(at), [...found.rotation], [...found.exponent]]"""
    states, rotation, exponent = scripts.run(script, places)
    centre, radius = BALL.section(ENERGY)
    place, turn = symmetric_fixed_point(BALL, ENERGY)
    around = np.full(4, (centre + radius * place) / BALL.g), np.full(4, turn)
    turns, _ = turns_and_growth(BALL.k, np.array(states).T / BALL.g, *around, 200)
    assert np.allclose(rotation, turns, rtol=0, atol=1e-9)
    spectra = [lyapunov_spectrum(BALL, state, 200, 1)["exponent"] for state in states]
    assert exponent == [float(spectrum[0, 0]) for spectrum in spectra]


def test_shares_are_of_the_decided_cells_once_most_are(scripts):
    script = """const [verdicts, cells, level, left] = args;
      const grids = [60, 100, 200].map((size) => new Grid(size));
      verdicts.forEach((verdict, i) => grids[1].verdict.set([verdict], i));
      grids[1].cells = cells;
      const shown = { window: {}, by: "verdict", grids, level, left };
      return Object.assign(new Colouring({}), shown).words"""
    verdicts = [1] * 50 + [2] * 30 + [3] * 15 + [4] * 5
    words = scripts.run(script, verdicts, 105, 1, 3)
    assert words == (
        "100 × 100 cells, 95.2 % decided; of these regular 50.0 %, chaotic 30.0 %, "
        "undecided 20.0 %; finer ones follow."
    )
    assert (
        scripts.run(script, verdicts, 120, 1, 3)
        == "100 × 100 cells, 83.3 % decided so far; finer ones follow."
    )
    assert scripts.run(script, verdicts, 120, 0, 3).startswith("A preview of 60 × 60 cells")


def test_colours_of_cells_are_those_of_their_numbers(scripts):
    script = """const grid = new Grid(2), [by, range] = args;
      grid.known.fill(1, 0, 3);
      grid.exponent.set([0.005, 0.5, NaN]);
      grid.rotation.set([0.1, 0.2, 0.15]);
      grid.growth.set([0, 0, 9]);
      grid.verdict.set([1, 2, 3]);
      const colours = { surface: "#000001", regular: "#000002", chaotic: "#000003",
        undecided: "#000004", sea: "#000005", ramp: ["#000010", "#000030"] };
      return [...grid.inks(by, range, colours)].map((ink) => (ink >>> 16) & 255)"""
    assert scripts.run(script, "verdict", [0, 1]) == [2, 3, 4, 0, 0]
    assert scripts.run(script, "exponent", [0.005, 0.5]) == [0x10, 0x30, 5, 0, 0]
    assert scripts.run(script, "rotation", [0.1, 0.2]) == [0x10, 5, 5, 0, 0]
    shades = scripts.run(
        "return [-1, 0, 0.5, 1, 2].map((s) => mixed(['#000000', '#204060', '#ffffff'], s))"
    )
    assert shades == ["#000000", "#000000", "#204060", "#ffffff", "#ffffff"]
    assert scripts.run("return packed('#123456')") == 0xFF563412


def test_regular_orbits_get_hues_in_turn(scripts):
    script = """const verdicts = ["regular", "chaotic", "undecided", "regular", null, "regular"];
      const orbits = verdicts.map((verdict) => {
        const orbit = new Orbit({ p: 0, q: 0, impacts: 9 }, { orbits: [] });
        return Object.assign(orbit, { facts: verdict && { verdict } });
      });
      assignHues(orbits, 2);
      return orbits.map(({ hue }) => hue)"""
    assert scripts.run(script) == [0, None, None, 1, None, 0]
