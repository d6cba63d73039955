"""The quantities that pictures report, and the facts of their captions, measured in datasets."""

import re
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ..config import MAIN, Config
from ..config.schema.kinds import KINDS
from ..declaration import hidden_by, imported
from ..records.artifacts import load
from ..records.sources import ROOT
from .captions import CAPTIONS, caption_of

# A function f(block, data), where `data` maps stages to datasets.
_Measure = Callable[[dict[str, Any], dict[str, Any]], dict[str, Any]]


def reported(block: dict[str, Any], data: dict[str, Any]) -> dict[str, str]:
    """Measure the quantities that a picture reports; `data` maps stages to datasets."""
    kind = KINDS[block["picture"]]
    return dict(imported(kind.reported_by)(block, **data)) if kind.headline else {}


def measured(
    root: Path, config: Config, variant: str, scene: str, measure: _Measure = reported
) -> dict[str, Any]:
    """Measure a scene, by default its quantities, in its datasets; ValueError names wrong files."""
    block, own = config.variants[variant][scene], config.data_of(variant, scene)
    data = {stage: load(root / file) for stage, file in own.items()}
    try:
        return measure(block.as_mapping(), data)
    except (LookupError, TypeError, AttributeError, ArithmeticError):
        wrong = ", ".join(own.values())
        raise ValueError(f"not datasets of {scene}: delete {wrong} and run again") from None


def hidden(block: dict[str, Any], data: dict[str, Any]) -> list[str]:
    """Say what the axes of a picture hide, a line each; `data` maps its stages to datasets."""
    kind = KINDS[block["picture"]]
    return hidden_by(kind.drawn_by, block, *(data[stage] for stage in kind.stages))


def facts(block: dict[str, Any], data: dict[str, Any]) -> dict[str, Any]:
    """Return what a caption says of what was computed and drawn, as values that JSON can hold.

    `hidden` has lines on what the axes hide, and `drawn` what the caption asks for of the texts and
    markers in the picture. The rest is what the function KIND_facts beside a kind's reports
    returns, if there is one.
    """
    module, _, kind = KINDS[block["picture"]].reported_by.rpartition(".")
    of_kind = getattr(import_module(module), f"{kind}_facts", None) if find_spec(module) else None
    found = {"hidden": hidden(block, data), "drawn": _drawn(block, data)}
    return found | (of_kind(block, **data) if of_kind else {})


def _drawn(block: dict[str, Any], data: dict[str, Any]) -> list[str]:
    """Return the texts and markers of a picture, which is drawn again, that its caption quotes."""
    from matplotlib.lines import Line2D  # takes long to import

    kind, caption = KINDS[block["picture"]], "".join(CAPTIONS.get(block["picture"], {}).values())
    if "d.drawn" not in caption:
        return []
    figure = imported(kind.drawn_by)(block, *(data[stage] for stage in kind.stages))
    found = {text.get_text() for text in figure.texts}
    found |= {str(line.get_marker()) for line in figure.findobj(Line2D) if len(line.get_xdata())}
    return sorted(each for each in found if f'"{each}"' in caption)


def caption_of_result(config: Config, variant: str, scene: str) -> str:
    """Return the caption of a picture in results as reStructuredText."""
    known = measured(ROOT, config, variant, scene, facts)
    name = scene if variant == MAIN else f"{variant}/{scene}"
    words = caption_of(name, config.variants[variant][scene].as_mapping(), known)
    texts = [f"{words.name}: {words.title}", words.shows, words.see, words.details]
    return re.sub(r"([\\`*_|])", r"\\\1", "\n\n".join(texts))
