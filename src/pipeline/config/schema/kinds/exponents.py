"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

from typing import Literal

from ..fields import ABSENT, Axis, YamlMapping
from ..scene import Dataset, OfRecords


class Exponents(OfRecords):
    """Lyapunov exponents against the number of impacts"""

    stages = ("lyapunov",)
    axes_depend_on = ("impacts",)
    along = {"impact": "impacts"}
    headline = "largest exponent"
    studied = "exponents"

    axes: dict[Literal["impact", "exponent", "largest"], Axis] = ABSENT
    """Limits and ticks of the axes `impact` (number of impacts), `exponent` (per impact) and
    `largest` (exponents of the inset). An axis that is left out has limits that hold its data."""

    @staticmethod
    def numbers(block: YamlMapping, lyapunov: Dataset) -> dict[str, str]:
        """Give the final exponents, and mean and spread of the largest ones."""
        import numpy as np

        from pseudorigid.dynamics.variables import final_exponents

        last = final_exponents(lyapunov)
        largest = np.sort(last[:, 0])
        spread = f", standard deviation {np.std(largest, ddof=1):.4f}" if largest.size > 1 else ""
        rounded = [np.round(row, 4) + 0.0 for row in (largest, *last)]  # 0.0 turns -0.0 into 0.0
        rows = [", ".join(f"{value:.4f}" for value in row) for row in rounded]
        return {
            "largest exponent": rows[0],
            "their mean": f"{np.mean(largest):.4f}{spread}",
            "all three of an orbit, at the end": "; ".join(rows[1:]),
            "impacts of each orbit": f"{int(lyapunov['impact'].values[-1]):,}",
        }
