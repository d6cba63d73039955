"""The theorems at the paper's numbers, k = 1/5 and g = 1/25: how each is checked and searched.

result = THEOREMS["horseshoe-outer"].check()
result.verdict, result.reason, result.digits      # "proved", "", {"entropy": "[0.018... "]}
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from importlib import resources

import pseudorigid

from ..checks import horseshoe, jump, periodic, twist
from ..checks.certificate import NotProvedError
from ..enclosure.surface import Surface

K, G = Fraction(1, 5), Fraction(1, 25)
HIGH, LOW = Surface(K, G, "1/100"), Surface(K, G, "1/1000")
# Figure 6 of the paper: x from 0.21 to 0.2116, xdot from 0.0925 to 0.0932.
WINDOW = tuple(tuple(map(Fraction, pair)) for pair in (("0.21", "0.2116"), ("0.0925", "0.0932")))
DIGITS = 30  # of an enclosure as text, at most: as many as certificates state


@dataclass(frozen=True)
class Result:
    """What checking a theorem's certificate gave.

    Attributes
    ----------
    name, statement, certificate : str
        Of the theorem, and its certificate's file.
    reason : str
        Why not; empty where it is proved.
    digits : dict of str to str
        Enclosures, with as many digits as are proved.
    margins : dict of str to float
        By how much the inequalities hold.
    seconds : float
        That it took.
    """

    name: str
    statement: str
    certificate: str
    reason: str
    digits: dict
    margins: dict
    seconds: float

    @property
    def verdict(self):
        """Either "proved" or "not proved"."""
        return "not proved" if self.reason else "proved"

    def line(self):
        """All of it in one line."""
        found = ", ".join(f"{name} = {value}" for name, value in self.digits.items())
        margins = ", ".join(f"{name} {value:.3g}" for name, value in self.margins.items())
        parts = [f"{self.certificate}: {self.statement}"]
        parts += [found] if found else []
        parts += [f"margins: {margins}"] if margins else []
        parts += [f"{self.seconds:.2f} s", self.reason, self.verdict]
        return "; ".join(part for part in parts if part)


@dataclass(frozen=True)
class Theorem:
    """A statement, and its checker with the statement's numbers.

    Attributes
    ----------
    name, statement : str
    checker : callable
        Takes a certificate's text and the bounds, returns a Finding.
    bounds : dict
        The statement's numbers, exact.
    """

    name: str
    statement: str
    checker: Callable
    bounds: dict

    @property
    def certificate(self):
        """The name of the certificate's file in the folder `certificates`."""
        return f"{self.name}.toml"

    def text(self):
        """The certificate as it stands in the package."""
        folder = resources.files(__package__.rpartition(".")[0]) / "certificates"
        data = (folder / self.certificate).read_bytes()
        pseudorigid.note_loaded(folder / self.certificate, data)
        return data.decode("utf-8")

    def prove(self, text):
        """What the checker finds of a certificate.

        Parameters
        ----------
        text : str

        Returns
        -------
        Finding

        Raises
        ------
        NotProvedError
            With the reason.
        """
        return self.checker(text, **self.bounds)

    def check(self, text=None):
        """The verdict on a certificate.

        Parameters
        ----------
        text : str, optional
            By default the package's own certificate.

        Returns
        -------
        Result
        """
        begin = time.perf_counter()
        digits, margins, reason = {}, {}, ""
        try:
            found = self.prove(self.text() if text is None else text)
            digits = {name: value.str(DIGITS) for name, value in found.digits.items()}
            margins = found.margins
        except FileNotFoundError:
            reason = "there is no such certificate"
        except NotProvedError as error:
            reason = " ".join(str(error).split()) or "no reason is given"
        seconds = time.perf_counter() - begin
        return Result(self.name, self.statement, self.certificate, reason, digits, margins, seconds)

    def of_any_size(self, text):
        """Whether the checker takes a certificate whatever the radius that it claims.

        Parameters
        ----------
        text : str

        Returns
        -------
        bool
        """
        try:
            self.checker(text, **self.bounds | {"radius": Fraction(0)})
        except NotProvedError:
            return False
        return True


def search_certificate(name):
    """A new certificate of a theorem: not proved, but proposed to its checker.

    Parameters
    ----------
    name : str
        A key of THEOREMS.

    Returns
    -------
    str

    Raises
    ------
    KeyError
        Where there is no such theorem.

    Examples
    --------
    >>> text = search_certificate("one-fixed-point")
    >>> THEOREMS["one-fixed-point"].check(text).verdict
    'proved'
    """
    from .searching import SEARCHES

    theorem = THEOREMS[name]
    return SEARCHES[theorem.checker](theorem)


def _orbit_theorem(name, surface, period, kind, radius):
    article = "an" if kind[0] in "ei" else "a"
    statement = (
        f"at E = {surface.energy} there is {article} {kind} orbit of period {period}, "
        f"the only one within {float(radius):g} of its points"
    )
    bounds = {"surface": surface, "period": period, "type": kind, "radius": Fraction(radius)}
    if kind == "hyperbolic":
        bounds["window"] = WINDOW
    return Theorem(name, statement, periodic.check, bounds)


def _twist_theorem(name, surface, period, radius):
    what = "fixed point" if period == 1 else f"orbit of period {period}"
    statement = (
        f"at E = {surface.energy} closed invariant curves surround the elliptic {what} in each of "
        "its neighbourhoods: it is stable for all time, and they fill a positive area"
    )
    bounds = {"surface": surface, "period": period, "radius": Fraction(radius)}
    return Theorem(name, statement, twist.check, bounds)


def _horseshoe_theorem(side, crossing, entropy):
    statement = (
        f"at E = {HIGH.energy} the {side} connections of the hyperbolic orbit of period 6 are "
        "transversal, and P has a uniformly hyperbolic invariant set around them, conjugate to a "
        f"mixing subshift of entropy at least {float(entropy):g}"
    )
    bounds = {
        "surface": HIGH, "period": 6, "radius": Fraction("1e-4"), "window": WINDOW,
        "crossing": tuple(map(Fraction, crossing)), "entropy": Fraction(entropy),
    }  # fmt: skip
    return Theorem(f"horseshoe-{side}", statement, horseshoe.check, bounds)


_THEOREMS = (
    _orbit_theorem("fixed-point", HIGH, 1, "elliptic", "4e-3"),
    _orbit_theorem("fixed-point-low", LOW, 1, "elliptic", "2e-3"),
    _orbit_theorem("six-elliptic", HIGH, 6, "elliptic", "1e-4"),
    _orbit_theorem("six-hyperbolic", HIGH, 6, "hyperbolic", "1e-4"),
    _orbit_theorem("six-inverse", HIGH, 6, "inverse hyperbolic", "5e-4"),
    _orbit_theorem("ten-elliptic", LOW, 10, "elliptic", "6e-6"),
    _orbit_theorem("twelve-elliptic", LOW, 12, "elliptic", "6e-6"),
    Theorem(
        "one-fixed-point",
        "at each energy up to k/2 - g, eq. (31), the map has exactly one fixed point",
        periodic.check_only_fixed_point,
        {"k": K, "g": G, "energy": K / 2 - G},
    ),
    _horseshoe_theorem("outer", ("0.326", "0.327"), "0.0185"),
    _horseshoe_theorem("inner", ("0.187", "0.188"), "0.0083"),
    _twist_theorem("twist-fixed-point", HIGH, 1, "4e-3"),
    _twist_theorem("twist-fixed-point-low", LOW, 1, "2e-3"),
    _twist_theorem("twist-six", HIGH, 6, "1e-4"),
    Theorem(
        "twist-zero",
        "as E rises the fixed point's twist falls through zero at the energy below, and the second "
        "twist is negative there: just below it shearless curves shrink into the point",
        twist.check_zero,
        {"k": K, "g": G, "radius": Fraction("2e-3"), "width": Fraction("1e-13")},
    ),
    Theorem(
        "jump-set",
        f"at E = {HIGH.energy} P is not continuous at the point below, and not a diffeomorphism; "
        "its jump set is one curve, from the rim to an inner end",
        jump.check,
        {"surface": HIGH, "radius": Fraction("1e-28"), "length": Fraction("0.404")},
    ),
    Theorem(
        "diffeomorphism",
        "at every E below g^2 (1 + k/2) P is analytic on the open disk of the section, with the "
        "analytic inverse R P R",
        jump.check_smooth,
        {"k": K, "g": G},
    ),
)
THEOREMS = {theorem.name: theorem for theorem in _THEOREMS}
