"""Someone who uses the explorer's page in Chromium by pointer, touch, keys and fields."""

import csv
import io
import re
import time

import numpy as np
from PIL import Image
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

MARGINS = {"left": 52, "top": 10, "right": 10, "bottom": 40}  # of the disk, in pixels
WHOLE = 1.12  # half the disk's view, in section radii


class Person:
    """What a person does with the page, and sees."""

    def __init__(self, browser):
        self.browser, self.driver, self.run = browser, browser.driver, browser.run

    def chain(self):
        return ActionChains(self.driver, duration=20)

    def open(self, address):
        self.browser.open("about:blank")
        self.browser.open(address)
        self.file = address.split("#")[0]

    def find(self, name):
        return self.driver.find_element("id", name)

    def text(self, name):
        return self.run("return document.getElementById(args[0]).textContent", name)

    def press(self, name):
        element = self.find(name)
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        element.click()

    def unfold(self, name):
        if self.run("return !document.getElementById(args[0]).open", name):
            self.driver.find_element("css selector", f"#{name} > summary").click()

    def clear_disk(self):
        """Show an empty disk."""
        self.press("as-disk")
        self.press("clear")

    def submit(self, name, text):
        """Type into a field and submit its form."""
        self.type(name, text)
        self.find(name).submit()

    def choose(self, name, value):
        Select(self.find(name)).select_by_value(value)

    def type(self, name, text):
        field = self.find(name)
        field.send_keys(Keys.CONTROL + "a")
        field.send_keys(Keys.BACKSPACE)
        field.send_keys(text)

    def state(self):
        """Fields of the address."""
        time.sleep(0.5)  # the address follows the state after 0.4 s
        text = self.run("return decodeURIComponent(location.hash.slice(1))")
        return dict(part.split("=", 1) for part in text.split("&"))

    def orbits(self):
        """(start, impacts so far, exponent, rotation number, verdict) of each orbit in the list."""
        rows = self.run(
            "return [...document.querySelectorAll('#orbits label')].map(n =>"
            " [...n.querySelectorAll('div')].slice(1).map(d => d.textContent))"
        )
        orbits = []
        for title, facts in rows:
            count, exponent, rotation, start = facts.replace("\N{MINUS SIGN}", "-").split(" · ")
            orbit = {"impacts": int(count.split()[0].replace(",", ""))}
            orbit |= {"exponent": exponent.split()[1], "rotation": rotation.split()[1]}
            orbit |= {"start": start.removeprefix("start ")}
            orbits.append(orbit | {"verdict": re.sub(r"^\d+\. ", "", title)})
        return orbits

    def wait(self, condition):
        """Wait until a condition is true, and return its value."""
        return WebDriverWait(self.driver, 60, 0.1).until(lambda _: condition())

    def settled(self):
        """Wait until all orbits are complete, and return them."""

        def complete():
            wanted = re.findall(r"\*(\d+)", self.state().get("orbits", ""))
            rows = self.orbits() if wanted else []
            return [r["impacts"] for r in rows] == [int(n) for n in wanted] and (rows or [None])

        return [row for row in self.wait(complete) if row]

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

    def saved(self, name="csv"):
        """Save the chosen orbit, or all, as CSV, and return the rows."""
        catch = (
            "window.saved = null; const make = URL.createObjectURL;"
            "URL.createObjectURL = blob => {"
            " blob.text().then(t => { window.saved = t }); return make(blob) }"
        )
        self.run(catch)
        self.unfold("record-panel")
        self.press(name)
        text = self.wait(lambda: self.run("return window.saved"))
        self.comments = [line[2:] for line in text.splitlines() if line.startswith("# ")]
        return list(csv.DictReader(line for line in text.splitlines() if line[:1] != "#"))

    def every_point(self):
        """The impacts of all orbits on the page, joined as in a dataset of orbits."""
        columns = {"x": [], "xdot": [], "udot": [], "tau": []}
        for at in range(len(self.orbits())):
            self.run("document.querySelectorAll('#orbits input')[args[0]].click()", at)
            rows = self.saved()[1:]
            for name, values in columns.items():
                values += [float(row[name]) for row in rows]
        return {name: np.array(values) for name, values in columns.items()}
