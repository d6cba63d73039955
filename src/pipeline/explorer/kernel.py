"""The kernel in JavaScript, translated from the files that numba compiles."""

from pathlib import Path

from ..records.sources import SRC
from .translate import Translator

_FOLDER = SRC / "pseudorigid/kernel"
# Functions that web/kernel_api.js calls, by their modules. What they call is translated too.
_FUNCTIONS = {
    "impact": ("impact_coefficients", "rebound", "step", "step_with_flight", "tangent", "reflect"),
    "spectrum": ("push_frame", "with_logarithms"),
    "section": ("radius_squared", "start", "contact_speed_squared", "chart_state"),
}
# Without it, functions find impacts by the march that never misses one.
_FIXED = frozenset({"root_finder"})


def javascript(folder: Path = _FOLDER) -> str:
    """Return a script that declares `kernel`, an object with the translated functions.

    Raises TranslationError if a file of `folder` has a construct that is not translated.
    """
    translator = Translator(folder, "src/pseudorigid/kernel", _FIXED)
    names = [
        translator.function(module, name).name
        for module, functions in _FUNCTIONS.items()
        for name in functions
    ]
    return (
        "// The impact map, from src/pseudorigid/kernel: the same operations in the same order.\n"
        "// Functions with several results leave them in `$out`.\n"
        'const kernel = (() => {\n"use strict";\n'
        f"{translator.javascript()}\n"
        f"return {{ $out, {', '.join(names)} }};\n"
        "})();\n"
    )
