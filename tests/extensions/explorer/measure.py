"""How smooth the explorer is, and how often the short form of its verdicts is wrong.

    export PYTHONPATH=src:tests
    .venv/bin/python tests/extensions/explorer/measure.py

On an idle machine, in Chromium: seconds until the section in colour is complete, energies a second
of "Play E", and pictures a second of a drag of E, also with a processor that is four times slower.
With the argument `verdicts`: chaotic orbits that are called regular, by 600,000 impacts each.
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from test_pixels import WORKER

from extensions.explorer import page
from helpers.parts import browsers
from helpers.project import SHIPPED, wait_for
from pipeline import config

DISK = "k=0.2&g=0.04&view=disk,115,40,0,0,1.12"
NOTE = "return document.getElementById('map-note').textContent"
# Pictures of another energy, and frames, while `act` goes on for some seconds.
COUNT = """
const [kind, seconds] = args, canvas = document.querySelector("#section .map");
const pen = canvas.getContext("2d"), draw = pen.drawImage.bind(pen), seen = new Set();
const E = document.getElementById("E"), slide = document.getElementById("E-slide");
let pictures = 0, frames = 0;
pen.drawImage = (...all) => { pictures += 1; seen.add(E.value); draw(...all); };
const begin = performance.now(), [low, high] = [slide.min, slide.max].map(Number);
if (kind === "play") document.getElementById("play-energy").click();
while (performance.now() - begin < 1000 * seconds) {
  await new Promise(requestAnimationFrame);
  frames += 1;
  if (kind === "play") continue;
  slide.value = low + (0.3 + 0.4 * ((performance.now() - begin) / 1000 / seconds)) * (high - low);
  slide.dispatchEvent(new Event("input", { bubbles: true }));
}
if (kind === "play") document.getElementById("play-energy").click();
else slide.dispatchEvent(new Event("change", { bubbles: true }));
delete pen.drawImage;
return [frames, pictures, seen.size].map(count => count / seconds);
"""
RATES = f"""{WORKER}
const [k, g, energy, starts] = args, found = {{ wrong: 0, undecided: 0, regular: 0 }};
const index = Uint32Array.from({{ length: starts.length / 2 }}, (_, i) => i);
let part = crowd.begin({{ k, g, energy, places: starts, index }});
const verdicts = [...part.verdict];
while (part.rest.index.length) {{
  part = crowd.further({{ k, g, energy, rest: part.rest, done: part.done }});
  part.index.forEach((cell, i) => (verdicts[cell] = part.verdict[i]));
}}
for (const i of index) {{
  const state = geometry.stateAt(k, g, energy, {{ p: starts[2 * i], q: starts[2 * i + 1] }});
  const follower = pseudorigid.follow(k, g, ...state);
  let chaotic = false;
  while (!chaotic && follower.impacts < 600000) chaotic = follower.advance(20000).size.at(-1) > 60;
  if (verdicts[i] > 2) found.undecided += 1;
  else if (chaotic !== (verdicts[i] === 2)) found[chaotic ? "wrong" : "regular"] += 1;
}}
return [found.wrong, found.regular, found.undecided];"""
SETTINGS = [(0.2, 0.04, e) for e in (0.001, 0.0015, 0.0025, 0.004, 0.01)] + [(1 / 3, 0.05, 0.003)]


def measure(browser, file):
    """Print seconds and rates."""
    for energy, by, complete in (
        (0.01, "exponent", "300 ×"), (0.01, "rotation", "300 ×"), (0.0015, "verdict", "of these"),
        (0.01, "verdict", "200 ×"),
    ):  # fmt: skip
        browser.open("about:blank")
        browser.open(f"{file}#{DISK}&E={energy}&map={by}")
        begin = time.perf_counter()
        wait_for(lambda words=complete: words in browser.run(NOTE))
        print(f"{by} at E = {energy}: {time.perf_counter() - begin:.2f} s: {browser.run(NOTE)}")
    for by, kind, slower in (
        ("exponent", "play", 1), ("verdict", "play", 1), ("exponent", "drag", 1),
        ("verdict", "drag", 1), ("exponent", "drag", 4), ("verdict", "drag", 4),
    ):  # fmt: skip
        browser.open("about:blank")
        browser.open(f"{file}#{DISK}&E=0.0015&map={by}")
        time.sleep(6)
        browser.driver.execute_cdp_cmd("Emulation.setCPUThrottlingRate", {"rate": slower})
        frames, pictures, energies = browser.run(COUNT, kind, 6)
        browser.driver.execute_cdp_cmd("Emulation.setCPUThrottlingRate", {"rate": 1})
        rates = f"{frames:.1f} frames, {pictures:.1f} pictures, {energies:.1f} energies a second"
        print(f"{kind}, {by}, {slower} times slower: {rates}")


def verdicts(browser):
    """Print how many of 600 random starts of each setting are judged wrongly."""
    for k, g, energy in SETTINGS:
        radius, angle = np.random.default_rng(1).uniform(size=(2, 600))
        places = np.sqrt(radius) * np.exp(2j * np.pi * angle)
        found = np.zeros(3, int)
        for part in np.split(places, 12):
            starts = np.stack([part.real, part.imag], axis=1).ravel().tolist()
            found += browser.run(RATES, k, g, energy, starts)
        print(
            f"k = {k:.3g}, E/g² = {energy / g**2:.4g}: called regular, chaotic, undecided: {found}"
        )


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        target = Path(scratch) / "explorer.html"
        target.write_text(page.render(config.load(SHIPPED)), "utf-8")
        with browsers.started("chromium", Path(scratch) / "profile") as opened:
            opened.open(target.as_uri())
            verdicts(opened) if sys.argv[1:] == ["verdicts"] else measure(opened, target.as_uri())
