"""Browsers and pages of the tests of the explorer."""

import browsers
import pytest
from doubles import SCRIPT
from person import Person
from project import SHIPPED
from slowly import slowly

from extensions.explorer import page
from pipeline import config


@pytest.fixture(scope="module", params=["chromium", *slowly("firefox")])
def browser(request, tmp_path_factory):
    """A browser on a page that has the kernel, and functions to read and write arrays."""
    folder = tmp_path_factory.mktemp(request.param)
    file = folder / "page.html"
    script = f"<script>{page.kernel_scripts()}\n{SCRIPT}</script>"
    file.write_text(f'<!doctype html><meta charset="utf-8">{script}', encoding="utf-8")
    with browsers.started(request.param, folder / "profile") as opened:
        opened.open(file.as_uri())
        yield opened


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    file = tmp_path_factory.mktemp("page") / "explorer.html"
    file.write_text(page.render(config.load(SHIPPED)), encoding="utf-8")
    return file.as_uri()


@pytest.fixture(scope="module")
def chromium(tmp_path_factory):
    with browsers.started("chromium", tmp_path_factory.mktemp("chromium"), 1400, 1000) as browser:
        yield browser


@pytest.fixture
def person(chromium, address, request):
    """Someone who opens the page, or one of its addresses; nothing may go wrong until the end."""
    chromium.resize(1400, 1000)
    user = Person(chromium, address)
    user.open(getattr(request, "param", ""))
    yield user
    assert chromium.errors() == []
    requests = "return performance.getEntriesByType('resource').map(r => r.name)"
    assert all(name.startswith(("blob:", "data:")) for name in chromium.run(requests))
