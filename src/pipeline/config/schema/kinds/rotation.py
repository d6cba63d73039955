"""Rotation number and exponent against the start."""

from collections.abc import Iterator

from ..fields import Between, Energies, YamlMapping, whole
from ..scene import CrossFieldError, Dataset, Scene, listing, not_elliptic


class Rotation(Scene):
    """rotation number and exponent against the start"""

    stages = ("rotation",)
    headline = "at the fixed point"

    energies: Energies
    """Energies, in m omega^2 R^2, whose rotation numbers are drawn beside those of `energy`."""
    starts: int = whole(2, 100_000)
    """Number of orbits at each energy. They start evenly along y = 0, from the fixed point to the
    rim of the section. More starts resolve narrower plateaus."""
    impacts: int = whole(100, 10_000_000)
    """Number of impacts of each orbit. Longer orbits give the rotation number more digits."""
    detail: Between
    """Part of the symmetry line y = 0 that is drawn at higher resolution, in section radii from the
    section's centre: `starts` further orbits start evenly in it, at `energy`."""
    detail_impacts: int = whole(100, 10_000_000)
    """Number of impacts of each orbit of the detail."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the fixed point, around which orbits rotate, is elliptic at each energy."""
        yield from super().cross_field_errors(block)
        yield from not_elliptic(block, "energy")
        yield from not_elliptic(block, "energies")

    @staticmethod
    def numbers(block: YamlMapping, rotation: Dataset) -> dict[str, str]:
        """Give the rotation number at the fixed point, at each energy."""
        numbers = listing(rotation, "{:.6f} at E = {:g}", "fixed_rotation", "energy")
        return {"at the fixed point": numbers}
