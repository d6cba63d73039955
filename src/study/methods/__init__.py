"""The methods that are compared.

`counted_methods` has the methods in this package's arithmetic, whose results are the same on every
machine. `libraries` has those of other packages, whose results are measurements.
"""

from dataclasses import dataclass

import numpy as np

from pseudorigid.dynamics.ball import Ball

Flights = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Method:
    """A method that finds the next impact; methods of a family differ in one setting."""

    name: str
    family: str

    def solve(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times of states just before an impact, and their cost, arrays (n,).

        A time is NaN if no root is found.
        """
        raise NotImplementedError
