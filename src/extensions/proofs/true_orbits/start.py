"""Exact starts of orbits."""

from collections.abc import Mapping

from flint import arb

from study.enclosure.surface import Exact, Surface, ball_of, exact


class Start:
    """An exact start, which gives balls of its coordinates at any precision.

    It is a fraction of the section's radius along y = 0, or a mapping with x and y or xdot. Raises
    ValueError if a number is not exact, or the start is on or beyond the rim.
    """

    def __init__(self, surface: Surface, start: Exact | Mapping[str, Exact]) -> None:
        self.surface = surface
        values = start if isinstance(start, Mapping) else {"start": start}
        if set(values) not in ({"start"}, {"x", "y"}, {"x", "xdot"}):
            raise ValueError(
                "a start is a fraction of the section's radius, or x and y, or x and xdot"
            )
        self.numbers = {name: exact(name, values[name]) for name in sorted(values)}
        if not self._is_inside():
            raise ValueError(f"the start {self} is not inside the section's rim at {surface}")

    def __str__(self) -> str:
        return ", ".join(f"{name} = {value}" for name, value in self.numbers.items())

    def _is_inside(self) -> bool:
        """Whether s > 0, decided in exact arithmetic."""
        k, g, energy = self.surface.k, self.surface.g, self.surface.energy
        if "start" in self.numbers:
            return -1 < self.numbers["start"] < 1
        x = self.numbers["x"]
        twice_kinetic = 2 * energy + x * (2 * g - k * x)
        if "y" in self.numbers:
            return (1 + k) * twice_kinetic > self.numbers["y"] ** 2
        xdot = self.numbers["xdot"]  # of the two udot = ±sqrt((2 T - xdot^2)/k), the positive one
        square = xdot * xdot
        return twice_kinetic > square and (xdot >= 0 or twice_kinetic > (1 + k) * square)

    def balls(self) -> tuple[arb, arb]:
        """Enclose x and y at the context's precision."""
        k, g, energy = self.surface.constants()
        numbers = {name: ball_of(value) for name, value in self.numbers.items()}
        if "start" in numbers:
            return g / k + numbers["start"] * self.surface.radius(), arb(0)
        x = numbers["x"]
        if "y" in numbers:
            return x, numbers["y"]
        xdot = numbers["xdot"]
        udot = ((2 * energy + x * (2 * g - k * x) - xdot * xdot) / k).sqrt()
        return x, xdot - k * udot
