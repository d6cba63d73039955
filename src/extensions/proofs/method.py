"""The method that computes true orbits."""

from typing import Annotated, Literal

from pipeline.config.schema.fields import Block, allowed


class Exact(Block):
    """a mapping with the key exact"""

    exact: Annotated[Literal[True], allowed("true, or no method at all")]
    """Compute the true orbit of each start, so that every number is a rounded true value. This
    takes effect in portraits and in backdrops of other pictures; other stages compute as usual."""
