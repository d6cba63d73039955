"""Speed of the page's kernel beside numba's: a table as in src/extensions/explorer/README.md.

    PYTHONPATH=tests .venv/bin/python tests/extensions/explorer/speed.py

The rows are medians of alternating runs. For many orbits numba has two lanes as the page has, since
it compiles for a processor without AVX, in a process of its own.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import browsers
import numpy as np
from project import SHIPPED, wait_for

from extensions.explorer import page
from pipeline import config
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
SSE2 = {"NUMBA_CPU_NAME": "nehalem", "NUMBA_CPU_FEATURES": ""}


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


def many_orbits_for_sse2():
    """Seconds per impact in another process, which compiles first."""
    command = [sys.executable, __file__, "many"]
    return float(subprocess.check_output(command, env=os.environ | SSE2).split()[-1])


def measure(name, folder):
    """Print a row of the table."""
    (folder / "explorer.html").write_text(page.render(config.load(SHIPPED)), "utf-8")
    address, seconds = (folder / "explorer.html").as_uri(), []
    with browsers.started(name, folder / "profile") as browser:
        browser.open(f"{address}#k=0.2")
        wait_for(lambda: browser.run("return Boolean(globalThis.pseudorigid)"))
        for _ in range(ROUNDS + 2):
            in_page = browser.run(KERNEL, IMPACTS, ORBITS, *states.chaotic())
            numba = one_orbit("last"), one_orbit("all"), many_orbits_for_sse2()
            seconds.append((*in_page, *numba, *browser.run(DRAWING, DRAWN, states.CHAOTIC)))
    seconds = np.array(seconds[2:])  # browser and numba compile first
    columns = [0, 3, 1, 4, 2, 5, 7, 6]
    rates = [f"{1e-6 / s:.2f}" for s in np.median(seconds, axis=0)[columns]]
    print(f"| {' | '.join([name.capitalize(), *rates])} |")


if __name__ == "__main__":
    if sys.argv[1:] == ["many"]:
        print(many_orbits(), many_orbits())
    else:
        for browser in browsers.PROGRAMS:
            with tempfile.TemporaryDirectory() as scratch:
                measure(browser, Path(scratch))
