"""Browsers and pages of the tests of the explorer. A browser is started once for all tests."""

import pytest

from extensions.explorer import page
from helpers.parts import browsers
from helpers.parts.doubles import SCRIPT
from helpers.parts.engine import Engine
from helpers.parts.person import Person
from helpers.project import SHIPPED
from helpers.slowly import slowly
from pipeline import config


@pytest.fixture(scope="session")
def chromium(tmp_path_factory):
    with browsers.started("chromium", tmp_path_factory.mktemp("chromium")) as browser:
        yield browser


@pytest.fixture(scope="session")
def firefox(tmp_path_factory):
    with browsers.started("firefox", tmp_path_factory.mktemp("firefox")) as browser:
        yield browser


@pytest.fixture(scope="session")
def webkit(tmp_path_factory):
    with browsers.started("webkit", tmp_path_factory.mktemp("webkit")) as browser:
        yield browser


@pytest.fixture(scope="session")
def engine():
    return Engine()


BROWSERS = slowly("chromium", "firefox", "webkit")


@pytest.fixture(scope="session", params=BROWSERS)
def either(request):
    """Chromium, Firefox and WebKit."""
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="session", params=["engine", *BROWSERS])
def kernel_runner(request):
    """What can run the kernel: an engine, and the browsers."""
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="session")
def scripts():
    """The scripts of the page and its worker, without what begins to draw and to compute."""
    found = Engine()
    found.load(page.kernel_scripts(), *map(page.script, (*page.APP[:-1], *page.WORKER[:-1])))
    return found


@pytest.fixture(scope="session")
def kernel_page(tmp_path_factory):
    """The address of a page that has the kernel, and functions to read and write arrays."""
    file = tmp_path_factory.mktemp("kernel") / "page.html"
    script = f"<script>{page.kernel_scripts()}\n{SCRIPT}</script>"
    file.write_text(f'<!doctype html><meta charset="utf-8">{script}', encoding="utf-8")
    return file.as_uri()


@pytest.fixture(autouse=True)
def page_is_left():
    """Leave the explorer after each test: it would go on drawing beside all other tests."""
    yield
    for browser in browsers.RUNNING:
        if browser.run("return document.getElementById('section') !== null"):
            browser.open(browsers.ELSEWHERE)


@pytest.fixture
def browser(kernel_runner, kernel_page):
    """An engine or a browser on the page of the kernel."""
    if kernel_runner.run("return location.href") != kernel_page:
        kernel_runner.open(kernel_page)
    return kernel_runner


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    """The address of the explorer."""
    file = tmp_path_factory.mktemp("page") / "explorer.html"
    file.write_text(page.render(config.load(SHIPPED)), encoding="utf-8")
    return file.as_uri()


@pytest.fixture
def person(chromium, address, request):
    """Someone who opens the page, or one of its addresses; nothing may go wrong until the end."""
    chromium.resize(1400, 1000)
    chromium.errors()  # of tests before
    user = Person(chromium, address)
    user.open(getattr(request, "param", ""))
    yield user
    assert chromium.errors() == []
    requests = "return performance.getEntriesByType('resource').map(r => r.name)"
    assert all(name.startswith(("blob:", "data:")) for name in chromium.run(requests))


@pytest.fixture
def phone(person):
    """Someone with a phone."""
    command = person.driver.execute_cdp_cmd
    metrics = {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True}
    command("Emulation.setDeviceMetricsOverride", metrics)
    command("Emulation.setTouchEmulationEnabled", {"enabled": True})
    person.open()
    yield person
    command("Emulation.setTouchEmulationEnabled", {"enabled": False})
    command("Emulation.clearDeviceMetricsOverride", {})
