"""Blocks of config.yaml: `prove`, and the method that computes true orbits."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pipeline.config.schema.fields import LARGEST, Block, allowed, whole


class Prove(Block):
    """How many impacts ./reproduce prove proves."""

    impacts: int = whole(1, LARGEST)
    """Number of impacts to prove in each figure whose data have millions of them. The impacts of
    the other figures are all proved."""


class Exact(Block):
    """The method that computes true orbits."""

    computes: ClassVar[Mapping[str, str]] = {
        "orbits": "extensions.proofs.true_orbits.orbit.true_scene_orbits"
    }

    exact: Annotated[Literal[True], allowed("true, or no method at all")]
    """Compute the true orbit of each start, so that every number is a rounded true value, in
    portraits and in backdrops of other pictures."""
