"""Scripts of the page in V8, without a browser."""

import json
import re
from pathlib import Path
from urllib.parse import unquote, urlparse

from py_mini_racer import MiniRacer

# Where a section of 500 x 420 pixels has places of a state, and whether they are inside.
PROJECTED = """const [state, places] = args;
const view = Object.create(SectionView.prototype);
Object.assign(view, { width: 500, height: 420, read: () => ({ state }) });
view.project();
const { k, g, energy } = state;
return [view.window(), places.map(([p, q]) => {
  const at = view.screen(...geometry.stateAt(k, g, energy, { p, q }));
  return at && [view.inside(at), at, view.placeOf(...at)];
})];"""

_TIMEOUT = 180  # seconds that a script may take
# What browsers add to the language, and scripts of tests need.
_ADDED = """
const ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
globalThis.atob = text => {
  let bytes = "", bits = 0, count = 0;
  for (const letter of text.replace(/=+$/, "")) {
    bits = ((bits << 6) | ALPHABET.indexOf(letter)) & 0xffff;
    count += 6;
    if (count >= 8) bytes += String.fromCharCode((bits >> (count -= 8)) & 255);
  }
  return bytes;
};
globalThis.btoa = bytes => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map(n => bytes.charCodeAt(i + n) || 0);
    const four = [a >> 2, ((a & 3) << 4) | (b >> 4), ((b & 15) << 2) | (c >> 6), c & 63];
    text += four.map((n, j) => (i + j > bytes.length ? "=" : ALPHABET[n])).join("");
  }
  return text;
};
globalThis.TextEncoder = class {
  encode(text) { return Uint8Array.from(text, letter => letter.charCodeAt(0)); } // of ASCII
};
globalThis.Blob = class { constructor(parts) { this.text = parts.join(""); } };
globalThis.location = { href: "about:blank", protocol: "file:", hash: "#k=0.2" };
globalThis.window = globalThis;
0"""


class Engine:
    """What runs scripts by the interface of the browsers."""

    def __init__(self):
        self.load()

    def load(self, *scripts):
        """Run scripts in a world of their own, one after the other."""
        self._engine = MiniRacer()
        for script in (_ADDED, *scripts):
            self._engine.eval(f"{script}\n;0")  # a result would be copied

    def open(self, address):
        """Run the scripts of a page, which has nothing else here."""
        text = Path(unquote(urlparse(address).path)).read_text(encoding="utf-8")
        where = f"location.href = {json.dumps(address)}"
        self.load(*re.findall(r"<script>(.*?)</script>", text, re.DOTALL), where)

    def run(self, script, *args):
        """Run the body of an async function, and return its result."""
        function = f"async (...args) => {{ {script} }}"
        text = f"({function})(...{json.dumps(args)}).then(value => JSON.stringify(value ?? null))"
        return json.loads(self._engine.eval(text).get(timeout=_TIMEOUT))
