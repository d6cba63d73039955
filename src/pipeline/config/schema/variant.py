"""The declaration of a variant of the paper's scenes."""

from typing import Annotated

from .fields import ABSENT, Block, Energy, PartOfBall, YamlMapping, allowed
from .method import Method


class Variant(Block):
    """a mapping with the keys ball, energy, method, scenes and scale, or some of them"""

    ball: PartOfBall = ABSENT
    """Replaces `k`, `g` or both in the ball of every scene."""
    energy: Energy = ABSENT
    """Replaces the energy of every scene."""
    method: Method = ABSENT
    """Replaces the method of every scene."""
    scale: float = allowed(
        "a number from 1e-6 to 1e6, by which every length is multiplied",
        default=ABSENT,
        ge=1e-6,
        le=1e6,
    )
    """Changes the unit of length. g, positions and velocities are multiplied by this number, and
    energies by its square; times and exponents stay."""
    scenes: Annotated[
        dict[str, Annotated[YamlMapping, allowed("a mapping with fields of the scene")]],
        allowed("a mapping from names of scenes to the fields that differ"),
    ] = ABSENT
    """Replaces fields of single scenes, after the fields above. Mappings are merged key by key;
    lists, numbers and texts are replaced."""
