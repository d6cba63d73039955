"""Speed of the page's kernel beside numba's, measured alternately in one run."""

import time

import numpy as np
import pytest

from pseudorigid import orbit
from pseudorigid.kernel import lanes
from pseudorigid.study import states

IMPACTS, ROUNDS = 400_000, 7
ORBITS = 256  # which advance together, in SIMD lanes
IN_THE_PAGE = """
const [impacts, orbits, ...state] = args, begin = performance.now();
pseudorigid.history(0.2, 0.04, ...state, impacts);
const between = performance.now();
const [x, xdot, udot] = state.map(value => new Float64Array(orbits).fill(value));
pseudorigid.iterateMany(0.2, 0.04, { x, xdot, udot, tau: x.slice() }, Math.floor(impacts / orbits));
return [between - begin, performance.now() - between];
"""


def one_orbit(start):
    """Seconds of numba's kernel for IMPACTS of one orbit."""
    begin = time.perf_counter()
    orbit(states.BALL, start, IMPACTS)
    return time.perf_counter() - begin


def many_orbits(start):
    """Seconds of numba's kernel for IMPACTS of many orbits, on one core."""
    x, v, w = (np.full(ORBITS, a) for a in start)
    out = np.empty((ORBITS, IMPACTS // ORBITS, 4))
    begin = time.perf_counter()
    lanes.steps(x, v, w, 0.2, 0.04, IMPACTS // ORBITS, np.empty(ORBITS), out)
    return (time.perf_counter() - begin) * IMPACTS / (IMPACTS // ORBITS * ORBITS)


@pytest.mark.slow
def test_the_page_has_half_of_the_speed_of_numba(browser, request, capsys):
    """Of one orbit in both; the median of ratios bears other processes that run now and then."""
    start = states.chaotic()
    seconds = []
    for _ in range(ROUNDS + 2):
        page = [ms / 1e3 for ms in browser.run(IN_THE_PAGE, IMPACTS, ORBITS, *start)]
        seconds.append((*page, one_orbit(start), many_orbits(start)))
    seconds = np.array(seconds[2:])  # both compile first
    one, many = np.median(seconds[:, 2:] / seconds[:, :2], axis=0)
    lanes_gain = np.median(seconds[:, 0] / seconds[:, 1])
    with capsys.disabled():
        rates = [f"{IMPACTS / 1e6 / s:.2f}" for s in np.median(seconds, axis=0)]
        print(
            f"\n{request.node.callspec.id}: million impacts a second: one orbit {rates[0]}, "
            f"numba {rates[2]} (ratio {one:.2f}); {ORBITS} orbits {rates[1]}, "
            f"numba {rates[3]} (ratio {many:.2f}); in lanes {lanes_gain:.2f} times one orbit"
        )
    assert one > 0.5
