"""What the paper prints: its ball, and the numbers of each figure's text, caption and axes.

Energies are in m omega^2 R^2, times in 1/omega. Numbers of points and the exponent are approximate
in the paper.
"""

from typing import Any

BALL = {"k": 0.2, "g": 0.04}
FIGURES: dict[str, dict[str, Any]] = {
    "fig2": {"energy": 0.01, "starts": 8, "points": 45_000},
    "fig3": {"energy": 0.01, "type": "elliptic", "period": 1, "duration": 16},
    "fig4": {"energy": 0.01, "type": "elliptic", "period": 6, "duration": 60},
    "fig5": {"energy": 0.01, "type": "hyperbolic", "period": 6},
    "fig6": {"energy": 0.01, "type": "hyperbolic", "period": 6},
    "fig7": {"energy": 0.01, "starts": 3, "impacts": 200_000, "exponent": 0.235},
    "fig8": {"energy": 0.001, "starts": 6, "points": 35_000},
}
WINDOW = {"x": (0.21, 0.2116), "xdot": (0.0925, 0.0932)}  # of Figure 6
EXPONENT: float = FIGURES["fig7"]["exponent"]  # largest one, after all impacts of Figure 7
