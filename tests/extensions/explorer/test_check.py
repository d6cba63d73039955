"""The page's own check of a machine, pressed in Chromium and in Firefox."""

import numpy as np
import pytest

from extensions.explorer import page
from extensions.processors.build import CompiledFile
from helpers.project import ROOT, SHIPPED, wait_for
from pipeline import config
from pseudorigid.kernel import arithmetic

SAME = (
    "Figure 2: the same bits here, in 45,000 impacts. "
    "Figure 8: the same bits here, in 35,000 impacts."
)
OTHER = (
    "Figure 2: other bits here, in 45,000 impacts, of x, xdot, udot, tau. "
    "Figure 8: other bits here, in 35,000 impacts, of x, xdot, udot, tau."
)
NOTE = "return document.getElementById('check-note').textContent"
RESOURCES = "return performance.getEntriesByType('resource').map(entry => entry.name)"


@pytest.fixture
def opened(either, tmp_path):
    """A function that opens the page from a file in a browser."""

    def show():
        text = page._with_data(page._packed(), config.load(SHIPPED), ROOT)  # of any kernel
        (tmp_path / "explorer.html").write_text(text, "utf-8")
        either.open((tmp_path / "explorer.html").as_uri())
        return either

    either.errors()  # of tests before
    return show


def checked(browser):
    """Press the button, and return the answer."""
    browser.click("#tab-help")
    browser.click("#check")
    wait_for(lambda: "Figure 8: " in browser.run(NOTE), 120)
    return browser.run(NOTE)


def test_the_page_says_that_the_bits_are_the_same(opened):
    browser = opened()
    assert checked(browser) == SAME
    assert browser.errors() == []
    assert all(name.startswith(("blob:", "data:")) for name in browser.run(RESOURCES))


def test_the_page_names_the_variables_that_a_changed_kernel_gives_other_bits(opened, monkeypatch):
    """One constant of the module has another last digit."""
    constant = np.array(arithmetic._S1)
    changed = np.nextafter(constant, 9.0).tobytes()
    module = page.KERNEL.path.read_bytes().replace(constant.tobytes(), changed)
    monkeypatch.setattr(CompiledFile, "content", lambda _: module)
    assert checked(opened()) == OTHER


def test_a_browser_without_the_kernel_says_so(opened, monkeypatch):
    monkeypatch.setattr(CompiledFile, "content", lambda _: b"no module")
    text = opened().run("return document.body.innerText")
    assert text.startswith("This page needs WebAssembly with SIMD") and text.count("\n") == 0


def test_nothing_can_be_fetched(opened):
    """The policy of the page forbids it, before the network is asked."""
    script = """const forbidden = new Promise(done =>
          document.addEventListener("securitypolicyviolation", e => done(e.effectiveDirective)));
        fetch("http://127.0.0.1:9/").catch(() => null);
        return await forbidden;"""
    browser = opened()
    assert browser.run(script) == "connect-src"
    wait_for(browser.errors)  # which report it later: no other test shall find it there
