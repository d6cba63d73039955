"""The paper's numbers beside those measured in our datasets."""

from ...config.declared.kinds import KINDS
from ...config.places import stages

# What the paper prints, in its text, captions and axes: scene -> quantity -> value.
PRINTED = {
    "fig2": {"orbits": "8", "impacts": "approximately 45,000", "energy": "0.01"},
    "fig3": {"orbit": "elliptic, period one", "energy": "0.01", "time": "0 to 16"},
    "fig4": {"orbit": "elliptic, period six", "energy": "0.01", "time": "0 to 60"},
    "fig5": {"orbit": "hyperbolic, period six", "energy": "0.01"},
    "fig6": {
        "orbit": "hyperbolic, period six",
        "energy": "0.01",
        "window, x": "0.21 to 0.2116",
        "window, xdot": "0.0925 to 0.0932",
        "x of the point": "between 0.21 and 0.2116",
        "xdot of the point": "between 0.0925 and 0.0932",
    },
    "fig7": {"largest exponent": "approximately 0.235"},
    "fig8": {"orbits": "6", "impacts": "approximately 35,000", "energy": "0.001"},
}


def measured(block, load):
    """Quantity -> value in words, of a scene's block; `load(stage)` reads one of its datasets."""
    return KINDS[block["picture"]].numbers(block, **{stage: load(stage) for stage in stages(block)})


def beside(scene, ours):
    """Rows (quantity, the paper's value or "not printed", ours) of a scene of the paper."""
    printed = PRINTED.get(scene, {})
    return [(name, printed.get(name, "not printed"), value) for name, value in ours.items()]
