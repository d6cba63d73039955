"""A small invariant curve, proved in half a second.

The theorems about curves take up to eleven seconds each. This curve is close to the fixed point, so
that it needs few cells and Fourier modes. It replaces them where any curve will do.
"""

from fractions import Fraction
from pathlib import Path

from extensions.proofs import THEOREMS
from extensions.proofs.checkers import curve
from extensions.proofs.theorems.statements import Theorem


class _Theorem(Theorem):
    def text(self) -> str:
        """Read the certificate, which is not in the package.

        It is search.propose(SMALL, [5, 1, 1, 2, 20], ("0.06", "0.0098", 64, 4, 3, 60), "1e-35").
        """
        return Path(__file__).with_name("small_curve.toml").read_text(encoding="utf-8")


SMALL = _Theorem(
    "small-curve", "a small curve surrounds the fixed point", curve.check,
    THEOREMS["curve-fixed-point-outer"].bounds | {
        "radius": Fraction("1e-6"), "rotation": (Fraction("0.1786"), Fraction("0.1787")),
        "share": Fraction("0.0069"), "error": Fraction("1e-35"),
    },
)  # fmt: skip
