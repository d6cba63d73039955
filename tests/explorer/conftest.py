"""Browsers and pages of the tests of the explorer."""

import browsers
import pytest

from pipeline.explorer import kernel, page

# Reads and writes arrays of doubles as base64, so that NaN, infinity and -0 pass unchanged.
_ARRAYS = """
const floats = text => new Float64Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
const text = array => {
  const bytes = pseudorigid.bytesOf(array);
  let result = "";
  for (let i = 0; i < bytes.length; i += 30000) {
    result += String.fromCharCode(...bytes.subarray(i, i + 30000));
  }
  return btoa(result);
};
Object.assign(globalThis, { kernel, floats, text }); // scripts of tests see only these
"""


def kernel_script():
    """The script of the page that computes."""
    return f"{kernel.javascript()}\n{page.script('kernel_api.js')}"


@pytest.fixture(scope="module", params=browsers.PROGRAMS)
def browser(request, tmp_path_factory):
    """A browser on a page that has the kernel, and functions to read and write arrays."""
    folder = tmp_path_factory.mktemp(request.param)
    file = folder / "page.html"
    script = f"<script>{kernel_script()}\n{_ARRAYS}</script>"
    file.write_text(f'<!doctype html><meta charset="utf-8">{script}', encoding="utf-8")
    with browsers.start(request.param, folder / "profile") as opened:
        opened.open(file.as_uri())
        yield opened
