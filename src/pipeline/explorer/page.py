"""The explorer as one HTML file, which needs no network and no server.

Its bytes depend on the tree alone: config.yaml, the kernel, the committed manifest and `web/`. The
content security policy allows the page's own scripts, by their hashes, and nothing from elsewhere.
docs/explorer.html is a copy. Renew it after a change:

    .venv/bin/python -m pipeline.explorer.page
"""

import base64
import hashlib
import json
from pathlib import Path
from typing import Any

from .. import config
from ..config.schema.fields import YamlMapping
from ..records.files import write_whole
from ..records.sources import ROOT
from . import compact, data, kernel

COPY = "docs/explorer.html"
WEB = Path(__file__).with_name("web")
# Scripts beside the kernel of both, those of the worker, and of the page, in their order.
BOTH = ("kernel_api.js", "geometry.js")
WORKER = ("analysis.js", "worker.js")
APP = (
    *("state.js", "orbits.js", "section.js", "time.js", "charts.js", "compute.js"),
    *("presets.js", "export.js", "controls.js", "main.js"),
)


def render(checked: YamlMapping, root: Path = ROOT) -> str:
    """Return the page.

    Raises
    ------
    translate.TranslationError
        The kernel has a construct that is not translated.
    """
    kernel_script = kernel_scripts()
    worker_script = _scripts(WORKER)
    app_script = _scripts(APP)
    style = compact.style(script("style.css"))
    policy = "; ".join(
        [
            "default-src 'none'",
            f"script-src {_source(kernel_script)} {_source(app_script)}",
            f"style-src {_source(style)}",
            "worker-src blob:",
            "img-src data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )
    parts = {
        "STYLE": f"<style>{style}</style>",
        "DATA": f'<script type="application/json" id="data">{_json(data.collect(checked, root))}'
        "</script>",
        "SCRIPT": f'<script id="kernel">{kernel_script}</script>\n'
        f'<script type="text/plain" id="worker">{worker_script}</script>\n'
        f"<script>{app_script}</script>",
    }
    page = compact.markup(script("index.html"))
    page = page.replace(
        '<meta charset="utf-8">',
        f'<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="{policy}">',
        1,
    )
    for name, text in parts.items():
        before, mark, after = page.partition(f"<!--{name}-->")
        if not mark:
            raise ValueError(f"web/index.html has no mark <!--{name}-->")
        page = before + text + after
    return page


def kernel_scripts() -> str:
    """Return the script that computes, in the page and in its worker."""
    return f"{kernel.javascript()}\n{_scripts(BOTH)}"


def _write_copy() -> None:
    """Write the committed copy, which a web server may show."""
    write_whole(ROOT / COPY, render(config.load(ROOT / "config.yaml")))


def script(name: str) -> str:
    """Return the text of a file of the page."""
    return (WEB / name).read_text(encoding="utf-8")


def _scripts(names: tuple[str, ...]) -> str:
    """Return scripts of `web/` as one, without comments."""
    return "".join(compact.script(script(name)) for name in names)


def _source(text: str) -> str:
    """Return how a content security policy calls a script or a style."""
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def _json(value: Any) -> str:
    """Return JSON that may stand in a script element."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


if __name__ == "__main__":
    _write_copy()
