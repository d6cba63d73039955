"""The methods of a scene: scan and bisection, and those of parts."""

from collections.abc import Mapping
from functools import reduce
from operator import or_
from typing import Annotated, Any

from pydantic import Discriminator, Tag

from ...declaration import imported, parts
from .fields import TAGS, Block, allowed


class Scan(Block):
    """a mapping with the keys scan and tolerance"""

    scan: float = allowed("the scan's step, a number from 0.001 to 1", ge=0.001, le=1)
    """Time step, in 1/omega, at which the sign of the gap between ball and floor is inspected, for
    instance 0.1. A smaller one misses fewer impacts; a ball whose impact is missed falls through
    the floor."""
    tolerance: float = allowed("a number from 1e-15 to 0.001", ge=1e-15, le=0.001)
    """Width in time, in 1/omega, at which bisection ends. 1.0e-12 leaves little but rounding, and
    scenes with manifolds allow no more."""


# Key that only a method of a part has -> the class of its block.
_BY_KEY: dict[str, type[Block]] = {
    key: imported(place) for each in parts().values() for key, (place, _) in each.methods.items()
}
METHOD_BLOCKS = {"scan and bisection": Scan} | _BY_KEY


def _tag(value: Any) -> str:
    """Return the tag of the method whose block or mapping a value is meant to be."""
    keys = value if isinstance(value, Mapping) else getattr(value, "model_fields_set", ())
    return next((TAGS[i] for i, key in enumerate(_BY_KEY, 1) if key in keys), TAGS[0])


_WORDS = ["a mapping with the keys scan and tolerance", *(f"{{{key}: true}}" for key in _BY_KEY)]
_TAGGED = [Annotated[block, Tag(TAGS[i])] for i, block in enumerate(METHOD_BLOCKS.values())]
_UNION: Any = Annotated[reduce(or_, _TAGGED), Discriminator(_tag)] if _BY_KEY else Scan
Method: Any = Annotated[_UNION, allowed(", or ".join(_WORDS))]
