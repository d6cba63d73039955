"""A periodic motion in time: Figures 3 and 4 of the paper."""

from typing import Literal

from ..fields import ABSENT, Axis, YamlMapping, allowed
from ..scene import Dataset, OfPeriodicOrbit


class Motion(OfPeriodicOrbit):
    """a periodic motion in time"""

    stages = ("motion",)
    axes_depend_on = ("period", "type", "duration")
    along = {"t": "duration"}
    headline = "orbit"
    studied = "motion"

    duration: float = allowed("a number with 0 < duration <= 10000", gt=0, le=10_000)
    """Length of time that is drawn, in 1/omega, from an impact on. The orbit repeats as needed."""
    axes: dict[Literal["t", "displacement"], Axis] = ABSENT
    """Limits and ticks of the axes `t` (time, 1/omega) and `displacement` (height, R, and strain).
    An axis that is left out has limits that hold its data."""

    @staticmethod
    def numbers(block: YamlMapping, periodic: Dataset, motion: Dataset) -> dict[str, str]:
        """Describe the orbit, the times drawn, its period in time and its strain."""
        from pseudorigid.dynamics.variables import of_type

        t = motion["t"].values
        orbit = of_type(periodic, block["type"])
        return Motion.about_orbit(periodic, block) | {
            "time": f"{t[0]:g} to {t[-1]:g}",
            "time of one period": f"{float(orbit['total_time']):.6f}",
            "impacts drawn": f"{motion.sizes['impact']:,}",
            "strain": f"{float(motion['strain'].min()):.4f} to {float(motion['strain'].max()):.4f}",
        }
