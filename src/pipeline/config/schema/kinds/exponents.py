"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

from ..fields import axes_of
from ..scene import OfRecords


class Exponents(OfRecords):
    """Lyapunov exponents against the number of impacts

    The three Lyapunov exponents of {{ s.starts|length }} orbits, one colour an orbit, against the
    number of impacts, up to {{ s.impacts|max if s.impacts is iterable else s.impacts }}, at
    energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}. The inset has the largest
    ones on a finer scale, each point of it below the same number of impacts, without the first
    quarter.

    What to see: one exponent stays above zero, so neighbours part exponentially; one is zero,
    since the energy is kept; and the third mirrors the first, since areas are kept. Single runs
    differ in the third digit.
    """

    stages = ("lyapunov",)
    axes_depend_on = ("impacts",)
    along = {"impact": "impacts"}
    headline = "largest exponent"
    studied = "exponents"
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.05
    starts: [0.1, 0.5]
    impacts: 2000
    records: 50
    """

    axes: axes_of("impact", "exponent", "largest") = None

    @staticmethod
    def numbers(block, lyapunov):
        """The last values of the largest exponent."""
        import numpy as np

        from pseudorigid.dynamics.variables import final_exponents

        last = final_exponents(lyapunov)
        largest = np.sort(last[:, 0])
        spread = f", standard deviation {np.std(largest, ddof=1):.4f}" if largest.size > 1 else ""
        rows = [np.round(row, 4) + 0.0 for row in (largest, *last)]
        rows = [", ".join(f"{value:.4f}" for value in row) for row in rows]
        return {
            "largest exponent": rows[0],
            "their mean": f"{np.mean(largest):.4f}{spread}",
            "all three of an orbit, at the end": "; ".join(rows[1:]),
            "impacts of each orbit": f"{int(lyapunov['impact'].values[-1]):,}",
        }
