"""Speed of the page's kernel beside numba's, measured alternately in one run."""

import os
import subprocess
import sys
import time
from pathlib import Path

import browsers
import numpy as np
import pytest
from project import wait_for

from pseudorigid import orbit
from pseudorigid.kernel import lanes
from study import states

IMPACTS, ROUNDS = 400_000, 7
ORBITS = 256  # which advance together, in SIMD lanes
DRAWN = 1_000_000  # impacts of the orbit that is drawn
# One orbit, one whose states are kept, then many, in seconds per impact.
KERNEL = """
const [impacts, orbits, ...state] = args;
const [x, xdot, udot] = state.map(value => new Float64Array(orbits).fill(value));
const many = { x, xdot, udot, tau: x.slice() };
const times = [performance.now()];
pseudorigid.iterate(0.2, 0.04, ...state, impacts);
times.push(performance.now());
pseudorigid.history(0.2, 0.04, ...state, impacts);
times.push(performance.now());
pseudorigid.iterateMany(0.2, 0.04, many, Math.floor(impacts / orbits));
times.push(performance.now());
return times.slice(1).map((end, i) => (end - times[i]) / 1e3 / impacts);
"""
# The worker alone, then the page that draws what the worker computes, once the orbit is past the
# beginning, which is slow so that one can watch.
DRAWING = """
const [impacts, fraction] = args, state = pseudorigid.start(0.2, 0.04, 0.01, fraction);
const computer = new Computer();
await computer.ask("open", { key: "alone", k: 0.2, g: 0.04, energy: 0.01, state });
const begin = performance.now();
await computer.ask("advance", { orbits: [["alone", impacts]], time: 1e9 });
const alone = (performance.now() - begin) / 1e3 / impacts;
computer.worker.terminate();
location.hash = `view=disk,115,40,0,0,1.12&orbits=${fraction}*${impacts}`;
let first = null;
for (;;) {
  await new Promise(requestAnimationFrame);
  const text = document.querySelector("#orbits .facts")?.textContent ?? "";
  const count = Number(text.split(" ")[0].replaceAll(",", ""));
  if (count > 20000) first ??= [performance.now(), count];
  if (count < impacts) continue;
  const drawn = (performance.now() - first[0]) / 1e3 / (impacts - first[1]);
  location.hash = "k=0.2";
  return [alone, drawn];
}
"""
# Measures many orbits for every line that it reads.
SSE2 = "import sys, test_speed as t\nfor _ in sys.stdin: print(t.many_orbits(), flush=True)"


def one_orbit(keep):
    """Seconds per impact of numba's kernel for one orbit, whose states are kept or not."""
    begin = time.perf_counter()
    orbit(states.BALL, states.chaotic(), IMPACTS, keep)
    return (time.perf_counter() - begin) / IMPACTS


def many_orbits():
    """Seconds per impact of numba's kernel for many orbits, on one core."""
    x, v, w = (np.full(ORBITS, a) for a in states.chaotic())
    begin = time.perf_counter()
    lanes.steps(x, v, w, 0.2, 0.04, IMPACTS // ORBITS, np.empty(ORBITS), np.empty((0, 0, 4)))
    return (time.perf_counter() - begin) / IMPACTS


@pytest.mark.slow
@pytest.mark.parametrize("name", browsers.PROGRAMS)
def test_the_page_has_half_of_the_speed_of_numba(name, address, tmp_path, capsys):
    """Prints a row of the table in src/extensions/explorer/README.md: medians of alternating runs.

    Numba has two lanes as the page has, since it compiles for a processor without AVX.
    """
    start, seconds = states.chaotic(), []
    paths = {"PYTHONPATH": os.pathsep.join(sys.path)}
    processor = {"NUMBA_CPU_NAME": "nehalem", "NUMBA_CPU_FEATURES": ""}
    with (
        browsers.started(name, tmp_path / "profile") as browser,
        subprocess.Popen(
            [sys.executable, "-c", SSE2],
            cwd=Path(__file__).parent,
            env=os.environ | paths | processor,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
        ) as two_lanes,
    ):
        browser.open(f"{address}#k=0.2")
        wait_for(lambda: browser.run("return Boolean(globalThis.pseudorigid)"))
        for _ in range(ROUNDS + 2):
            page = browser.run(KERNEL, IMPACTS, ORBITS, *start)
            two_lanes.stdin.write("\n")
            numba = one_orbit("last"), one_orbit("all"), float(two_lanes.stdout.readline())
            seconds.append((*page, *numba, *browser.run(DRAWING, DRAWN, states.CHAOTIC)))
        two_lanes.stdin.close()
    seconds = np.array(seconds[2:])  # browser and numba compile first
    rates = [f"{1e-6 / s:.2f}" for s in np.median(seconds, axis=0)]
    ratios = {
        (3, 0): "one orbit, page / compiled",
        (4, 1): "one orbit, kept, page / compiled",
        (5, 2): f"{ORBITS} orbits, page / compiled for SSE2",
        (0, 2): f"page, {ORBITS} orbits / one orbit",
        (6, 7): "orbit drawn / worker alone",
    }
    medians = {words: np.median(seconds[:, a] / seconds[:, b]) for (a, b), words in ratios.items()}
    with capsys.disabled():
        one, kept, many, numba, numba_kept, sse2, alone, drawn = rates
        columns = name.capitalize(), one, numba, kept, numba_kept, many, sse2, drawn, alone
        print(f"\n| {' | '.join(columns)} |")
        print("".join(f"  {words}: {ratio:.2f}\n" for words, ratio in medians.items()), end="")
    assert medians["one orbit, page / compiled"] > 0.5
