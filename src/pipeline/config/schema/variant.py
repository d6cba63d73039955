"""What a variant is: the paper's scenes with some values replaced."""

from typing import Annotated, Any

from pydantic import Field

from .fields import LARGEST, Block, Energy, Method, PartOfBall, real, whole


class Prove(Block):
    """a mapping with the key impacts"""

    impacts: whole(1, LARGEST)
    """impacts of each figure with millions of them that are proved"""


class Variant(Block):
    """a mapping with the keys ball, energy, method, scenes and scale, or some of them"""

    ball: PartOfBall = None
    """of every scene, in the place of its own"""
    energy: Energy = None
    """of every scene"""
    method: Method = None
    """of every scene"""
    scale: real(
        "a number from 1e-6 to 1e6, by which every length is multiplied", ge=1e-6, le=1e6
    ) = None
    """another unit of length: g times scale, energies times its square"""
    scenes: Annotated[
        dict[str, Any],
        Field(description="a mapping from names of scenes to the fields that differ"),
    ] = None
    """further fields of single scenes; mappings merge, lists are replaced"""
