"""Speed of the page's kernel beside the compiled one, measured alternately in one run."""

import time

import numpy as np
import pytest

from pseudorigid import orbit
from pseudorigid.kernel import lanes
from pseudorigid.study import states

IMPACTS, ROUNDS = 400_000, 7
ORBITS = 256  # which the compiled kernel advances together, in SIMD lanes
IN_THE_PAGE = """
const [impacts, ...state] = args, begin = performance.now();
pseudorigid.history(0.2, 0.04, ...state, impacts);
return performance.now() - begin;
"""


def one_orbit(start):
    """Seconds of the compiled kernel for IMPACTS of one orbit."""
    begin = time.perf_counter()
    orbit(states.BALL, start, IMPACTS)
    return time.perf_counter() - begin


def many_orbits(start):
    """Seconds of the compiled kernel for IMPACTS of many orbits, on one core."""
    x, v, w = (np.full(ORBITS, a) for a in start)
    out = np.empty((ORBITS, IMPACTS // ORBITS, 4))
    begin = time.perf_counter()
    lanes.steps(x, v, w, 0.2, 0.04, IMPACTS // ORBITS, np.empty(ORBITS), out)
    return (time.perf_counter() - begin) * IMPACTS / (IMPACTS // ORBITS * ORBITS)


@pytest.mark.slow
def test_the_page_has_a_seventh_of_the_compiled_speed(browser, request, capsys):
    """Of one orbit in both; the median of ratios bears other processes that run now and then."""
    start = states.chaotic()
    seconds = np.array(
        [
            (browser.run(IN_THE_PAGE, IMPACTS, *start) / 1e3, one_orbit(start), many_orbits(start))
            for _ in range(ROUNDS + 2)
        ]
    )[2:]  # both compile first
    one, many = np.median(seconds[:, 1:] / seconds[:, :1], axis=0)
    with capsys.disabled():
        rates = [f"{IMPACTS / 1e6 / s:.2f}" for s in np.median(seconds, axis=0)]
        print(
            f"\n{request.node.callspec.id}: {rates[0]} million impacts a second; compiled "
            f"{rates[1]} for one orbit (ratio {one:.2f}), {rates[2]} for many (ratio {many:.2f})"
        )
    assert one > 1.0 / 7.0
