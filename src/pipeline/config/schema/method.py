"""The methods of a scene: scan and bisection, and those of parts."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Discriminator

from ...declaration import files
from .fields import FIRST, SECOND, TAGS, Block, allowed, declared_in


class Scan(Block):
    """a mapping with the keys scan and tolerance"""

    scan: float = allowed("the scan's step, a number from 0.001 to 1", ge=0.001, le=1)
    """Time step, in 1/omega, at which the sign of the gap between ball and floor is inspected, for
    instance 0.1. A smaller one misses fewer impacts; a ball whose impact is missed falls through
    the floor."""
    tolerance: float = allowed("a number from 1e-15 to 0.001", ge=1e-15, le=0.001)
    """Width in time, in 1/omega, at which bisection ends. 1.0e-12 leaves little but rounding, and
    scenes with manifolds allow no more."""


# Key of config.yaml, or of a scene's `method`, that a part adds -> the class of its block.
SETTINGS: dict[str, type[Block]] = {}
for _package in files("settings.py"):
    SETTINGS |= declared_in(f"{_package}.settings")
_METHODS = {key: each for key, each in SETTINGS.items() if hasattr(each, "computes")}
BLOCKS = {key: each for key, each in SETTINGS.items() if key not in _METHODS}


def _tag(value: Any) -> str:
    """Return the tag of the method whose block or mapping a value is meant to be."""
    keys = value if isinstance(value, Mapping) else getattr(value, "model_fields_set", ())
    return TAGS[not _METHODS.keys().isdisjoint(keys)]


_WORDS = ["a mapping with the keys scan and tolerance", *map("{{{}: true}}".format, _METHODS)]
_BLOCKS: Any = Annotated[Scan, FIRST]
for _block in _METHODS.values():
    _BLOCKS |= Annotated[_block, SECOND]
_BY_TAG = [Discriminator(_tag)] if _METHODS else []
Method: Any = Annotated[_BLOCKS, *_BY_TAG, allowed(", or ".join(_WORDS))]
