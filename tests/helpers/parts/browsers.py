"""Chromium, Firefox and WebKit, driven by Selenium.

Debian 12 has no geckodriver, so Firefox is driven by WebDriver BiDi, which it speaks itself. WebKit
has no headless mode: it has a screen of Xvfb. All browsers have the same interface: `open` a page,
`click`, `run` a script, and `errors`.
"""

import json
import os
import shutil
import subprocess
from contextlib import closing, contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from selenium import webdriver
from selenium.webdriver.remote.websocket_connection import WebSocketConnection

from helpers.project import ROOT, wait_for

PROGRAMS = {
    "chromium": ("chromium", "chromedriver"),
    "firefox": ("firefox-esr",),
    "webkit": ("WebKitWebDriver", "Xvfb"),
}
_TIMEOUT = 180  # seconds that a script may take
RUNNING = []
# A page that is left for. After about:blank, Firefox sometimes never opens the next file.
ELSEWHERE = (ROOT / "requirements/uv.txt").as_uri()


@contextmanager
def started(name, folder, width=1400, height=1000):
    """Start a browser with its profile in `folder`; skip the test if it is not installed."""
    missing = [program for program in PROGRAMS[name] if not shutil.which(program)]
    if missing:
        pytest.skip(f"{' and '.join(missing)} not installed (Debian packages, see .ci/run)")
    kinds = {"chromium": Chromium, "firefox": Firefox, "webkit": WebKit}
    with closing(kinds[name](folder, width, height)) as opened:
        RUNNING.append(opened)
        yield opened
        RUNNING.remove(opened)


class Driven:
    """A browser by a Selenium driver."""

    driver: webdriver.Remote

    def open(self, address):
        self.driver.get(address)

    def run(self, script, *args):
        """Run the body of an async function in the page, and return its result."""
        return self.driver.execute_script(
            f"return (async (...args) => {{ {script} }})(...arguments)", *args
        )

    def click(self, selector):
        """Click with the pointer on the first element that a selector finds."""
        self.driver.find_element("css selector", selector).click()

    def resize(self, width, height):
        self.driver.set_window_size(width, height)

    def close(self):
        self.driver.quit()


class WebKit(Driven):
    """WebKit's small browser on a screen of its own."""

    def __init__(self, folder, width, height):
        folder.mkdir(parents=True, exist_ok=True)
        reading, writing = os.pipe()
        self._screen = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1600x1200x24"],
            pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(writing)
        with open(reading) as number:
            display = f":{number.readline().strip()}"
        options = webdriver.WebKitGTKOptions()
        options.binary_location = str(next(Path("/usr/lib").glob("*/webkit2gtk-4.*/MiniBrowser")))
        options.add_argument("--automation")
        variables = os.environ | {
            "DISPLAY": display, "HOME": str(folder), "WEBKIT_DISABLE_COMPOSITING_MODE": "1",
            "WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS": "1", "NO_AT_BRIDGE": "1",
        }  # fmt: skip
        service = webdriver.WebKitGTKService(shutil.which("WebKitWebDriver"), env=variables)
        self.driver = webdriver.WebKitGTK(options, service)
        self.driver.set_script_timeout(_TIMEOUT)
        self.resize(width, height)

    def open(self, address):
        super().open(address)
        self.run(
            "globalThis.failures ??= []; const keep = e => failures.push("
            "String(e.message ?? e.reason ?? e.violatedDirective));"
            "for (const kind of ['error', 'unhandledrejection', 'securitypolicyviolation'])"
            " addEventListener(kind, keep)"
        )

    def errors(self):
        """Return exceptions in the page since it was opened or since the last call."""
        return self.run("return (globalThis.failures ?? []).splice(0)")

    def close(self):
        super().close()
        self._screen.kill()
        self._screen.wait()


class Chromium(Driven):
    """Chromium by chromedriver."""

    def __init__(self, folder, width, height):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in (
            "headless=new", "no-sandbox", "disable-gpu", "disable-dev-shm-usage",
            f"user-data-dir={folder}", f"window-size={width},{height}",
        ):  # fmt: skip
            options.add_argument(f"--{argument}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        service = webdriver.ChromeService(shutil.which("chromedriver"))
        self.driver = webdriver.Chrome(options, service)
        self.driver.set_script_timeout(_TIMEOUT)

    def errors(self):
        """Return messages of the console since the last call: errors and warnings."""
        return [entry["message"] for entry in self.driver.get_log("browser")]


class Firefox:
    """Firefox by Selenium's connection for WebDriver BiDi."""

    def __init__(self, folder, width, height):
        folder.mkdir(parents=True, exist_ok=True)
        self._process = subprocess.Popen(
            [shutil.which("firefox-esr"), "--headless", "--remote-debugging-port=0",
             "--no-remote", "--profile", str(folder), f"--width={width}", f"--height={height}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={"HOME": str(folder), "PATH": "/usr/bin:/bin", "MOZ_DISABLE_CONTENT_SANDBOX": "1"},
        )  # fmt: skip
        server = folder / "WebDriverBiDiServer.json"
        wait_for(lambda: server.is_file() and server.read_text().endswith("}"))
        port = json.loads(server.read_text())["ws_port"]
        self._socket = WebSocketConnection(f"ws://127.0.0.1:{port}/session", _TIMEOUT, 0.01)
        self._command("session.new", capabilities={})
        (page,) = self._command("browsingContext.getTree")["contexts"]
        self._page, self._messages = page["context"], []
        logged = SimpleNamespace(event_class="log.entryAdded", from_json=dict)
        self._socket.add_callback(logged, self._messages.append)
        self._command("session.subscribe", events=[logged.event_class])

    def _command(self, method, **parameters):
        reply = self._socket.send_cmd(method, parameters)
        assert "result" in reply, reply
        return reply["result"]

    def open(self, address):
        self._command("browsingContext.navigate", context=self._page, url=address, wait="complete")

    def run(self, script, *args):
        """Run the body of an async function in the page, and return its result."""
        function = f"(async (...args) => {{ {script} }})(...JSON.parse($given))"
        reply = self._command(
            "script.callFunction",
            functionDeclaration=f"async $given => JSON.stringify(await {function})",
            arguments=[{"type": "string", "value": json.dumps(args)}],
            awaitPromise=True,
            target={"context": self._page},
        )
        assert reply["type"] == "success", reply["exceptionDetails"]["text"]
        return json.loads(reply["result"].get("value", "null"))

    def middle(self, selector):
        """Scroll to the first element that a selector finds, and return where its middle is."""
        return self.run(
            "const e = document.querySelector(args[0]); e.scrollIntoView({block: 'center'});"
            "const b = e.getBoundingClientRect();"
            "return [b.left + b.width / 2, b.top + b.height / 2].map(Math.round)",
            selector,
        )

    def click(self, selector):
        """Click with the pointer on the first element that a selector finds."""
        self.tap("mouse", [self.middle(selector)])

    def tap(self, kind, *paths):
        """Move pointers along paths at once, from where they press to where they let go."""
        fingers = [
            [
                {"type": "pointerMove", "x": path[0][0], "y": path[0][1], "duration": 20},
                {"type": "pointerDown", "button": 0},
                *({"type": "pointerMove", "x": x, "y": y, "duration": 50} for x, y in path[1:]),
                {"type": "pointerUp", "button": 0},
            ]
            for path in paths
        ]
        parameters = {"pointerType": kind}
        actions = [
            {"type": "pointer", "id": f"{kind}{i}", "parameters": parameters, "actions": finger}
            for i, finger in enumerate(fingers)
        ]
        self._command("input.performActions", context=self._page, actions=actions)
        self._command("input.releaseActions", context=self._page)

    def errors(self):
        """Return exceptions in the page since the last call."""
        texts = [each["text"] for each in self._messages if each["type"] == "javascript"]
        self._messages.clear()
        return texts

    def close(self):
        try:
            self._command("browser.close")
            self._process.wait(30)
        finally:
            self._process.kill()
            self._socket.close()
