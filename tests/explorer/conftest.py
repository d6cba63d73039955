"""Browsers and pages of the tests of the explorer."""

import browsers
import pytest
from doubles import SCRIPT

from pipeline.explorer import page


@pytest.fixture(scope="module", params=browsers.PROGRAMS)
def browser(request, tmp_path_factory):
    """A browser on a page that has the kernel, and functions to read and write arrays."""
    folder = tmp_path_factory.mktemp(request.param)
    file = folder / "page.html"
    script = f"<script>{page.kernel_scripts()}\n{SCRIPT}</script>"
    file.write_text(f'<!doctype html><meta charset="utf-8">{script}', encoding="utf-8")
    with browsers.start(request.param, folder / "profile") as opened:
        opened.open(file.as_uri())
        yield opened
