"""Speed of the page's kernel beside numba's: tables as in src/extensions/explorer/README.md.

    PYTHONPATH=tests .venv/bin/python tests/extensions/explorer/speed.py
    PYTHONPATH=tests .venv/bin/python tests/extensions/explorer/speed.py colours
    PYTHONPATH=tests .venv/bin/python tests/extensions/explorer/speed.py memory

The rows are medians of alternating runs. For many orbits numba has two lanes as the page has, since
it compiles for a processor without AVX, in a process of its own. `colours` measures the section in
colour, and `memory` that of all the browser's processes while an orbit runs on for ten minutes.
"""

import os
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager, suppress
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
# Seconds until a change of a selection or a slider has the coarse picture and the fine one.
COLOURING = """
const [id, value] = args, field = document.getElementById(id), times = [];
const finer = () => document.getElementById("map-note").textContent.includes("finer");
const begin = performance.now();
field.value = value;
field.dispatchEvent(new Event(id === "map" ? "change" : "input", { bubbles: true }));
for (const coarse of [true, false]) {
  while (finer() !== coarse) await new Promise(requestAnimationFrame);
  times.push((performance.now() - begin) / 1e3);
}
field.dispatchEvent(new Event("change", { bubbles: true }));
return times;
"""
NOTE = "return document.getElementById('map-note').textContent"
MINUTES = 10  # for which an orbit runs on
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
    seconds = []
    with opened(name, folder, "k=0.2") as browser:
        for _ in range(ROUNDS + 2):
            in_page = browser.run(KERNEL, IMPACTS, ORBITS, *states.chaotic())
            numba = one_orbit("last"), one_orbit("all"), many_orbits_for_sse2()
            seconds.append((*in_page, *numba, *browser.run(DRAWING, DRAWN, states.CHAOTIC)))
    seconds = np.array(seconds[2:])  # browser and numba compile first
    columns = [0, 3, 1, 4, 2, 5, 7, 6]
    rates = [f"{1e-6 / s:.2f}" for s in np.median(seconds, axis=0)[columns]]
    print(f"| {' | '.join([name.capitalize(), *rates])} |")


def measure_colours(name, folder):
    """Print seconds until the coarse and the fine picture, for each colouring and a slider."""
    with opened(name, folder, "view=disk,115,40,0,0,1.12") as browser:
        rows = {"exponent": [], "verdict": [], "slider of E": []}
        for _ in range(ROUNDS):
            for by in ("exponent", "verdict"):
                browser.run("location.hash = 'k=0.2&view=disk,115,40,0,0,1.12'")
                time.sleep(1)
                rows[by].append(browser.run(COLOURING, "map", by))
            browser.run("location.hash = 'k=0.2&view=disk,115,40,0,0,1.12&map=exponent'")
            wait_for(lambda: "300 ×" in browser.run(NOTE))
            rows["slider of E"].append(browser.run(COLOURING, "E-slide", 0.4))
        for what, times in rows.items():
            coarse, fine = np.median(times, axis=0)
            print(f"| {name.capitalize()} | {what} | {coarse:.2f} | {fine:.2f} |")


def measure_memory(name, folder):
    """Print how much memory the browser has more after an orbit has run on."""
    with opened(name, folder, "view=disk,115,40,0,0,1.12&orbits=0.534522*1000&chosen=0") as browser:
        time.sleep(5)
        before = memory(os.getpid())
        browser.run("document.getElementById('run-on').click()")
        time.sleep(60 * MINUTES)
        facts = browser.run("return document.querySelector('#orbits .facts').textContent")
        more = memory(os.getpid()) - before
        print(f"| {name.capitalize()} | {facts.split(' · ')[0]} | {more:.0f} MB |")


def memory(process):
    """Megabytes of a process's descendants, what they share counted once."""
    total = 0.0
    for child in Path(f"/proc/{process}/task/{process}/children").read_text().split():
        with suppress(OSError):
            rows = Path(f"/proc/{child}/smaps_rollup").read_text().splitlines()
            total += sum(int(row.split()[1]) for row in rows if row.startswith("Pss:")) / 1000
            total += memory(child)
    return total


@contextmanager
def opened(name, folder, address):
    """A browser on an address of the page."""
    (folder / "explorer.html").write_text(page.render(config.load(SHIPPED)), "utf-8")
    with browsers.started(name, folder / "profile") as browser:
        browser.open(f"{(folder / 'explorer.html').as_uri()}#{address}")
        wait_for(lambda: browser.run("return Boolean(globalThis.pseudorigid)"))
        yield browser


if __name__ == "__main__":
    if sys.argv[1:] == ["many"]:
        print(many_orbits(), many_orbits())
    else:
        act = {"colours": measure_colours, "memory": measure_memory}.get(sys.argv[-1], measure)
        for browser in browsers.PROGRAMS:
            with tempfile.TemporaryDirectory() as scratch:
                act(browser, Path(scratch))
