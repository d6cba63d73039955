"""Someone who uses the explorer's page."""

import base64
import csv
import io
import re
from typing import NamedTuple

import numpy as np
from PIL import Image
from selenium.webdriver import ActionChains, Keys

from helpers.parts import browsers
from helpers.project import wait_for

MARGINS = {"left": 52, "top": 10, "right": 10, "bottom": 40}  # of the disk, in pixels
WHOLE = 1.12  # half the disk's view, in section radii
DISK = f"view=disk,115,40,0,0,{WHOLE}"
# Answers for the tests: the orbits' rows, and the bytes of the next file that is saved.
HELP = """
const texts = selector => [...document.querySelectorAll(selector)].map(n => n.textContent);
globalThis.titles = () => texts('#orbits label > div > div:first-child');
globalThis.facts = () => texts('#orbits .facts');
globalThis.swatches = () => [...document.querySelectorAll('#orbits .swatch')]
  .map(n => n.style.backgroundColor);
const make = URL.createObjectURL, letter = b => String.fromCharCode(b);
URL.createObjectURL = blob => {
  if (blob.type !== 'text/javascript') globalThis.saved = blob.arrayBuffer().then(
    bytes => [blob.type, btoa(Array.from(new Uint8Array(bytes), letter).join(''))]);
  return make(blob);
};
"""


class View(NamedTuple):
    """What the section shows: a surface with its angles, or a disk with its middle and size."""

    kind: str
    azimuth: float
    elevation: float
    x: float
    y: float
    half: float


class Visitor:
    """Someone at the page in either browser."""

    def __init__(self, browser, file):
        self.browser, self.file, self.run = browser, file, browser.run

    def open(self, address=""):
        self.browser.open(browsers.ELSEWHERE)
        self.browser.open(f"{self.file}#{address}" if address else self.file)
        self.run(HELP)
        if not address and self.text("play") == "Pause":  # the first picture runs
            self.run("document.getElementById('play').click()")
        self.settle()

    def reload(self):
        self.run("location.reload()")
        wait_for(lambda: self.run("return document.readyState === 'complete' && !globalThis.facts"))
        self.run(HELP)
        self.settle()

    def settle(self):
        """Wait until all orbits are complete, or have stopped early."""
        counts = "return facts().map((t, i) => [t.split(' ')[0].replaceAll(',', ''), titles()[i]])"

        def complete():
            wanted = re.findall(r"\*(\d+)", self.state().get("orbits", ""))
            rows = self.run(counts)
            return len(wanted) == len(rows) and all(
                (count == most and "…" not in title) or " stops: " in title
                for most, (count, title) in zip(wanted, rows, strict=True)
            )

        wait_for(complete)

    def state(self):
        """Fields of the address, which follows the state 0.4 s after a frame has been drawn."""
        text = self.run(
            "await new Promise(requestAnimationFrame);"
            "await new Promise(done => setTimeout(done, 500));"
            "return decodeURIComponent(location.hash.slice(1))"
        )
        return dict(part.split("=", 1) for part in text.split("&"))

    def view(self):
        kind, *numbers = self.state()["view"].split(",")
        return View(kind, *map(float, numbers))

    def starts(self):
        return [part.split("*")[0] for part in self.state().get("orbits", "").split(";") if part]

    def text(self, name):
        return self.run("return document.getElementById(args[0]).textContent", name)

    def value(self, name):
        return self.run("return document.getElementById(args[0]).value", name)

    def reveal(self, name):
        """Open the panel or menu that an element is in, and scroll to it."""
        self.run(
            "const shown = document.getElementById(args[0]);"
            "for (let n = shown; n; n = n.parentElement) {"
            " if (n.matches('details')) n.open = true;"
            " if (n.matches('[role=tabpanel]') && n.hidden)"
            "  document.getElementById(n.getAttribute('aria-labelledby')).click(); }"
            "shown.scrollIntoView({block: 'center'})",
            name,
        )

    def press(self, name):
        """Click on a button, in a panel that is open then."""
        self.reveal(name)
        self.browser.click(f"#{name}")

    def set(self, name, *values):
        """Set a field, or drag a slider over some values and let go."""
        self.run(
            "const field = document.getElementById(args[0]);"
            "for (const value of args[1]) {"
            " field.value = value; field.dispatchEvent(new Event('input', {bubbles: true}));"
            " await new Promise(done => setTimeout(done, 60)); }"
            "field.dispatchEvent(new Event('change', {bubbles: true}))",
            name,
            values,
        )

    def dispatch(self, kinds, across, down, target="section", **more):
        """Dispatch pointer or wheel events at a share of an element's size, all at once."""
        self.run(
            "const [kinds, across, down, target, more] = args;"
            "const node = document.getElementById(target), box = node.getBoundingClientRect();"
            "const type = kinds === 'wheel' ? WheelEvent : PointerEvent;"
            "node.setPointerCapture = () => {};"
            "for (const kind of kinds.split(' ')) node.dispatchEvent("
            "new type(kind, {clientX: box.left + across * box.width,"
            " clientY: box.top + down * box.height, pointerId: 1, pointerType: 'mouse',"
            " bubbles: true, cancelable: true, ...more}))",
            *(kinds, across, down, target, more),
        )

    def start_at(self, x, y, impacts):
        """Type where an orbit starts, and how long it is."""
        for name, value in (("impacts", impacts), ("start-x", x), ("start-y", y)):
            self.set(name, str(value))
        self.run("document.getElementById('start-form').requestSubmit()")

    def states(self):
        """The states x, xdot, udot of the chosen orbit, from its CSV."""
        self.settle()
        rows = self.table()[1]
        return np.array([[float(row[name]) for name in ("x", "xdot", "udot")] for row in rows])

    def saved(self, name):
        """Press a button that saves a file, and return its type and its bytes."""
        self.run("globalThis.saved = null")
        self.press(name)
        wait_for(lambda: self.run("return globalThis.saved !== null"))
        kind, text = self.run("return await saved")
        return kind, base64.b64decode(text)

    def table(self, name="csv"):
        """Save the chosen orbit, or all, as CSV, and return the comments and the rows."""
        lines = self.saved(name)[1].decode().splitlines()
        comments = [line for line in lines if line[0] == "#"]
        return comments, [*csv.DictReader(lines[len(comments) :])]


class Person(Visitor):
    """Someone at the page in Chromium, with a pointer and a keyboard."""

    def __init__(self, browser, file):
        super().__init__(browser, file)
        self.driver = browser.driver

    def chain(self):
        return ActionChains(self.driver, duration=20)

    def find(self, name):
        return self.driver.find_element("id", name)

    def clear_disk(self):
        """Show an empty disk."""
        self.press("as-disk")
        self.press("clear")

    def type(self, name, text):
        self.reveal(name)
        self.find(name).send_keys(Keys.CONTROL + "a", Keys.NULL, Keys.BACKSPACE, text)

    def submit(self, name, text):
        """Type into a field and submit its form."""
        self.type(name, text)
        self.run("document.getElementById(args[0]).form.requestSubmit()", name)

    def settled(self):
        """Wait until all orbits are complete, and return what the list says about each."""
        self.settle()
        orbits = []
        for title, facts in self.run("return titles().map((title, i) => [title, facts()[i]])"):
            count, exponent, rotation, start = facts.replace("\N{MINUS SIGN}", "-").split(" · ")
            orbit = {"impacts": int(count.split()[0].replace(",", ""))}
            orbit |= {"exponent": exponent.split()[1], "rotation": rotation.split()[1]}
            orbit |= {"start": start.removeprefix("start ")}
            orbits.append(orbit | {"verdict": re.sub(r"^\d+\. ", "", title)})
        return orbits

    def spot(self, p, q=0.0):
        """Where a place of the section is in the whole disk, in pixels from the box's middle."""
        box = self.find("section").rect
        wide = box["width"] - 2 - MARGINS["left"] - MARGINS["right"]
        tall = box["height"] - 2 - MARGINS["top"] - MARGINS["bottom"]
        scale = min(wide, tall) / 2 / WHOLE
        across = MARGINS["left"] + wide / 2 - box["width"] / 2 + 1 + p * scale
        down = MARGINS["top"] + tall / 2 - box["height"] / 2 + 1 - q * scale
        return round(across), round(down)

    def pointer(self, spot, element="section"):
        """Move the pointer to a place in pixels from an element's middle, and begin a chain."""
        box = self.find(element)
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", box)
        return self.chain().move_to_element_with_offset(box, *spot)

    def click(self, p, q=0.0):
        self.pointer(self.spot(p, q)).click().perform()

    def drag(self, start, end):
        chain = self.pointer(start).click_and_hold()
        for share in (0.3, 0.7, 1.0):
            at = [round(a + share * (b - a)) for a, b in zip(start, end, strict=True)]
            chain = chain.move_to_element_with_offset(self.find("section"), *at)
        chain.release().perform()

    def pixels(self):
        """What the section shows, seen from the top of the page."""
        self.run("window.scrollTo(0, 0)")
        picture = self.find("section").screenshot_as_png
        return np.array(Image.open(io.BytesIO(picture)).convert("RGBA"))

    def still(self):
        """What the section shows once branches have grown."""
        shown = [self.pixels()]
        wait_for(lambda: shown.append(self.pixels()) or np.array_equal(*shown[-2:]))
        return shown[-1]

    def place(self):
        """The coordinates that are shown at the pointer."""
        numbers = re.findall(r"[−\d.]+", self.text("where"))[:2]
        return [float(number.replace("−", "-")) for number in numbers]

    def every_point(self):
        """The impacts of all orbits on the page, joined as in a dataset of orbits."""
        rows = [row for row in self.table("csv-all")[1] if row["impact"] != "0"]
        return {
            name: np.array([float(r[name]) for r in rows]) for name in ("x", "xdot", "udot", "tau")
        }
