"""What a variant is: the paper's scenes with some values replaced."""

from typing import Annotated, Any

from pydantic import Field

from .fields import Block, Energy, Method, PartOfBall, real


class Variant(Block):
    """a mapping with the keys ball, energy, method, scenes and scale, or some of them"""

    ball: PartOfBall = None
    energy: Energy = None
    method: Method = None
    scale: real(
        "a number from 1e-6 to 1e6, by which every length is multiplied", ge=1e-6, le=1e6
    ) = None
    scenes: Annotated[
        dict[str, Any],
        Field(description="a mapping from names of scenes to the fields that differ"),
    ] = None
