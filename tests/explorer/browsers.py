"""Real browsers for tests: Debian's Chromium by Selenium, Debian's Firefox by Marionette.

Debian 12 has no geckodriver, so the client of Firefox's own protocol is here. Both browsers have
the same interface: `open` a page, `click`, `run` a script, and `errors`.
"""

import json
import shutil
import socket
import subprocess
import time
from pathlib import Path

import pytest

PROGRAMS = {"chromium": ("chromium", "chromedriver"), "firefox": ("firefox-esr",)}
_TIMEOUT = 600  # seconds that a script may take
# What a page's script gets: its arguments, and `done`, which ends the script with a result or an
# error. Exceptions of the script itself are reported as errors, too.
_SCRIPT = """
const done = arguments[arguments.length - 1];
(async (...args) => {{ {} }})(...[...arguments].slice(0, -1)).then(
  value => done({{value}}), error => done({{error: String(error && error.stack || error)}}));
"""


class ScriptError(Exception):
    """A script in a page ended with an exception."""


def start(name, folder, width=1200, height=900):
    """Start a browser with its profile in `folder`; skip the test if it is not installed."""
    missing = [program for program in PROGRAMS[name] if not shutil.which(program)]
    if missing:
        pytest.skip(f"{' and '.join(missing)} not installed (Debian packages, see .ci/run)")
    return {"chromium": Chromium, "firefox": Firefox}[name](Path(folder), width, height)


class _Browser:
    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.quit()

    def run(self, script, *args):
        """Run the body of an async function in the page, and return its result."""
        result = self._async(_SCRIPT.format(script), list(args))
        if "error" in result:
            raise ScriptError(result["error"])
        return result.get("value")


class Chromium(_Browser):
    """Chromium by Selenium and chromedriver."""

    def __init__(self, folder, width, height):
        webdriver = pytest.importorskip("selenium.webdriver")
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

    def open(self, address):
        self.driver.get(address)

    def _async(self, script, args):
        return self.driver.execute_async_script(script, *args)

    def click(self, selector):
        """Click with the pointer on the first element that a selector finds."""
        self.driver.find_element("css selector", selector).click()

    def resize(self, width, height):
        self.driver.set_window_size(width, height)

    def errors(self):
        """Return messages of the console since the last call: errors and warnings."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def quit(self):
        self.driver.quit()


class Firefox(_Browser):
    """Firefox by Marionette: JSON messages, each after its length, on a local socket."""

    def __init__(self, folder, width, height):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "user.js").write_text(
            'user_pref("marionette.port", 0);\n'  # it chooses a port and writes it to a file
            'user_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
        )
        self._log = (folder / "log").open("w+")
        self._process = subprocess.Popen(
            [shutil.which("firefox-esr"), "--headless", "--marionette", "--no-remote",
             "--profile", str(folder), f"--width={width}", f"--height={height}"],
            stdout=self._log, stderr=subprocess.STDOUT,
            env={"HOME": str(folder), "PATH": "/usr/bin:/bin", "MOZ_DISABLE_CONTENT_SANDBOX": "1"},
        )  # fmt: skip
        self._socket = self._connected(folder / "MarionetteActivePort")
        self._count, self._read = 0, 0
        self._message()  # the greeting
        self._command("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {}}})
        self._command("WebDriver:SetTimeouts", {"script": 1000 * _TIMEOUT})

    def _connected(self, port_file, patience=60):
        """Return the socket once the browser listens."""
        end = time.monotonic() + patience
        while time.monotonic() < end and self._process.poll() is None:
            try:
                return socket.create_connection(("127.0.0.1", int(port_file.read_text())))
            except (OSError, ValueError):
                time.sleep(0.1)
        self._process.kill()
        raise RuntimeError(f"Firefox does not answer: {Path(self._log.name).read_text()[-500:]}")

    def _message(self):
        size = b""
        while not size.endswith(b":"):
            size += self._socket.recv(1)
        data = b""
        while len(data) < int(size[:-1]):
            data += self._socket.recv(int(size[:-1]) - len(data))
        return json.loads(data)

    def _command(self, name, parameters=None):
        self._count += 1
        text = json.dumps([0, self._count, name, parameters or {}])
        self._socket.sendall(f"{len(text.encode())}:{text}".encode())
        _, _, error, result = self._message()
        if error:
            raise ScriptError(f"{error['error']}: {error['message']}")
        return result

    def open(self, address):
        self._command("WebDriver:Navigate", {"url": address})

    def _async(self, script, args):
        parameters = {"script": script, "args": args, "sandbox": None}
        return self._command("WebDriver:ExecuteAsyncScript", parameters)["value"]

    def click(self, selector):
        """Click with the pointer on the first element that a selector finds."""
        how = {"using": "css selector", "value": selector}
        (element,) = self._command("WebDriver:FindElement", how)["value"].values()
        self._command("WebDriver:ElementClick", {"id": element})

    def errors(self):
        """Return lines about exceptions in pages since the last call.

        Other lines of the console may be the browser's own.
        """
        self._log.seek(self._read)
        text = self._log.read()
        self._read = self._log.tell()
        marks = "JavaScript error: file:", "JavaScript error: blob:"
        return [line for line in text.splitlines() if any(mark in line for mark in marks)]

    def quit(self):
        try:
            self._command("Marionette:Quit", {"flags": ["eForceQuit"]})
            self._process.wait(30)
        except (OSError, ValueError, ScriptError, subprocess.TimeoutExpired):
            self._process.kill()
        self._socket.close()
        self._log.close()
