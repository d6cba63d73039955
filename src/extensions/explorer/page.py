"""The explorer as one HTML file, which needs no network and no server.

Its bytes depend on the tree alone: config.yaml, the kernel, the committed manifest and `web/`. The
content security policy allows the page's own scripts, by their hashes, and nothing from elsewhere.
Every page is the committed copy, src/extensions/explorer/explorer.html, with the data of a config.
Renew it after a change, for which a package is installed that packs scripts:

    .venv/bin/python -m pipeline.renew
"""

import base64
import hashlib
import json
import re
from contextlib import suppress
from pathlib import Path
from typing import Any

from extensions.processors.build import CompiledFile
from pipeline import config
from pipeline.cli.errors import UsageError
from pipeline.cli.packages import add_packages
from pipeline.config.schema.kinds import KINDS
from pipeline.declaration import RENEW
from pipeline.records.files import read_text
from pipeline.records.sources import ROOT

from . import data

COPY = "src/extensions/explorer/explorer.html"
WEB = Path(__file__).with_name("web")
KERNEL = CompiledFile(
    Path(__file__).parent / "compiled" / "kernel.wasm",
    "extensions.explorer.compiled.entry_points",
    "wasm",
)
PRESETS = "presets.js of parts"
_DATA = '<script type="application/json" id="data">'
# Scripts of both, those of the worker, and of the page, in their order.
BOTH = ("kernel_api.js", "geometry.js")
WORKER = ("analysis.js", "crowd.js", "worker.js")
APP = (
    *("state.js", "orbits.js", "section.js", "colouring.js", "filling.js", "time.js", "charts.js"),
    *("twin.js", "families.js", "compute.js", "presets.js"),
    PRESETS,
    *("svg.js", "export.js", "atlas.js", "guide.js", "ball_controls.js", "orbit_controls.js"),
    *("view_controls.js", "pointer_controls.js", "time_controls.js", "periodic_controls.js"),
    *("record_controls.js", "controls.js", "main.js"),
)


def render(checked: config.Config, root: Path = ROOT) -> str:
    """Return the page with a config's data; ValueError if the committed copy is not current."""
    page = read_text(ROOT / COPY) if (ROOT / COPY).exists() else ""
    if _made_from() not in page:
        raise ValueError(f"{COPY} was made from other files than these: run {RENEW}")
    return _with_data(page, checked, root)


def _made_from() -> str:
    """Return an element of the page with a hash of all that it is made from, but for its data."""
    files = [Path(__file__), ROOT / "requirements" / "explorer.txt"]
    files += [WEB / name for name in ("index.html", "style.css")]
    texts = [*map(read_text, files), kernel_scripts(), *map(script, (*WORKER, *APP))]
    digest = hashlib.sha256("\0".join(texts).encode()).hexdigest()
    return f'<meta name="made-from" content="{digest}">'


def _with_data(page: str, checked: config.Config, root: Path) -> str:
    """Return a page with the data of a config in the place of those that it has."""
    before, begin, rest = page.partition(_DATA)
    _, end, after = rest.partition("</script>")
    return f"{before}{begin}{_json(data.collect(checked, root))}{end}{after}"


def _packed() -> str:
    """Return the page without data."""
    kernel_script = kernel_scripts()
    worker_script, app_script = (_minified("application/javascript", p) for p in (WORKER, APP))
    style = _minified("text/css", ("style.css",))
    policy = "; ".join(
        [
            "default-src 'none'",
            f"script-src 'wasm-unsafe-eval' {_source(kernel_script)} {_source(app_script)}",
            f"style-src {_source(style)}",
            "worker-src blob:",
            "img-src data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
    security = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    parts = {
        "POLICY": f"{security}\n{_made_from()}",
        "STYLE": f"<style>{style}</style>",
        "DATA": f"{_DATA}</script>",
        "SCRIPT": f'<script id="kernel">{kernel_script}</script>\n'
        f'<script type="text/plain" id="worker">{worker_script}</script>\n'
        f"<script>{app_script}</script>",
    }
    page = _minified("text/html", ("index.html",))
    for name, text in parts.items():
        before, mark, after = page.partition(f"<!--{name}-->")
        if not mark:
            raise ValueError(f"web/index.html has no mark <!--{name}-->")
        page = f"{before}\n{text}\n{after}"
    return page


def kernel_scripts() -> str:
    """Return the script that computes, in the page and in its worker."""
    module = base64.b64encode(KERNEL.content()).decode()
    return "\n".join([f'const KERNEL = "{module}";', *map(script, BOTH)])


def script(name: str) -> str:
    """Return the text of a file of the page, or of the presets of all parts."""
    paths = data.of_parts("presets.js") if name == PRESETS else [WEB / name]
    return "".join(map(read_text, paths))


def has_preset(kind: str) -> bool:
    """Return whether presets.js of a part says how the page shows a kind of picture."""
    return bool(re.search(rf"\b{kind}[:(,]", script(PRESETS)))


def _minified(kind: str, names: tuple[str, ...]) -> str:
    """Return files of `web/` as one of a media type, without what nobody reads in the page."""
    import minify  # starts threads, which no process that forks should have

    minify.config({"html-keep-comments": True})  # marks, where parts are put in
    text: str = minify.string(kind, "".join(map(script, names)))
    return text


def _source(text: str) -> str:
    """Return how a content security policy calls a script or a style."""
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def _json(value: Any) -> str:
    """Return JSON that may stand in a script element."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def committed() -> dict[str, str]:
    """Return the committed copy by its path; what it is made from is compiled and packed first."""
    lacking = [name for name, kind in KINDS.items() if kind.on_section and not has_preset(name)]
    if lacking:
        names = ", ".join(lacking)
        raise ValueError(f"presets.js has no {names}: write it, or say on_section = False")
    KERNEL.renew()
    checked = config.load(ROOT / "config.yaml")
    with suppress(ValueError):
        return {COPY: render(checked)}
    try:
        add_packages("explorer")
    except UsageError as error:
        raise ValueError(str(error)) from None
    return {COPY: _with_data(_packed(), checked, ROOT)}
