"""The theorems at the paper's numbers, k = 1/5 and g = 1/25, with their checkers.

result = THEOREMS["horseshoe-outer"].check()
result.verdict, result.reason, result.digits      # "proved", "", {"entropy": "[0.018... "]}
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from importlib import resources
from typing import Any, NamedTuple

import xarray as xr

from paper import values
from pipeline.loading import note_loaded
from pseudorigid.verified.flight import NotProvedError

from ..checkers import (
    curve,
    events,
    fixed_point,
    graph,
    horseshoe,
    jump,
    one_zero,
    periodic,
    twist,
)
from ..checkers.certificate import Finding, Range, Window
from ..enclosure.surface import Surface

BALL = {name: Fraction(str(values.BALL[name])) for name in "kg"}


def _surface(energy: str) -> Surface:
    return Surface(BALL["k"], BALL["g"], Fraction(energy))


FIG2, FIG8 = _surface("1/100"), _surface("1/1000")
LIMIT = BALL["k"] / 2 - BALL["g"]  # of the energy, eq. (31)
MOST_DIGITS = 30  # of an enclosure as text: as many as certificates state


@dataclass(frozen=True)
class Result:
    """The result of checking a theorem's certificate."""

    name: str
    statement: str
    certificate: str  # its file
    reason: str  # why it is not proved; empty if it is
    digits: dict[str, str]  # enclosures, with as many digits as are proved
    margins: dict[str, float]  # by how much the inequalities hold

    @property
    def verdict(self) -> str:
        """Either "proved" or "not proved"."""
        return "not proved" if self.reason else "proved"

    def line(self) -> str:
        """Format the whole result in one line."""
        digits = ", ".join(f"{name} = {value}" for name, value in self.digits.items())
        margins = ", ".join(f"{name} {value:.3g}" for name, value in self.margins.items())
        parts = [f"{self.certificate}: {self.statement}", digits]
        parts += [f"margins: {margins}"] if margins else []
        return "; ".join(part for part in (*parts, self.reason, self.verdict) if part)


@dataclass(frozen=True)
class Theorem:
    """A statement, and its checker with the statement's numbers, which are exact."""

    name: str
    wording: str  # a format string that may name all of `_words`
    checker: Callable[..., Finding]  # takes a certificate's text and the bounds
    bounds: dict[str, Any]
    hints: dict[str, Any] = field(default_factory=dict)  # arguments of the search for a certificate

    @property
    def statement(self) -> str:
        """The statement in words, with the numbers that the checker is given."""
        text = self.wording.format(**_words(self.bounds))
        its = self.bounds.get("surface")
        k, g = (its.k, its.g) if its else (self.bounds["k"], self.bounds["g"])
        ball = "" if (k, g) == (BALL["k"], BALL["g"]) else f"for k = {k} and g = {g}, "
        return ball + text

    @property
    def certificate(self) -> str:
        """Name of the certificate's file in the folder `certificates`."""
        return f"{self.name}.toml"

    def text(self) -> str:
        """Read the package's own certificate; raises NotProvedError if it cannot be read."""
        folder = resources.files(__package__.rpartition(".")[0]) / "certificates"
        if not (folder / self.certificate).is_file():  # reading a FIFO could wait for ever
            raise NotProvedError("there is no such certificate")
        try:
            data = (folder / self.certificate).read_bytes()
            note_loaded(str(folder / self.certificate), data)
            return data.decode("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise NotProvedError(f"the certificate cannot be read: {error}") from None

    def prove(self, text: str | None = None) -> Finding:
        """Run the checker on a certificate, by default the package's own.

        Raises NotProvedError.
        """
        return self.checker(self.text() if text is None else text, **self.bounds)

    def check(self, text: str | None = None) -> Result:
        """Return the verdict on a certificate, by default the package's own."""
        finding, reason = Finding(), ""
        try:
            finding = self.prove(text)
        except NotProvedError as error:
            reason = " ".join(str(error).split()) or "no reason is given"
        digits = {name: value.str(MOST_DIGITS) for name, value in finding.digits.items()}
        about = self.name, self.statement, self.certificate, reason
        return Result(*about, digits, finding.margins)

    def holds_for_any_radius(self, text: str) -> bool:
        """Whether the checker accepts a certificate whatever radius it claims."""
        try:
            self.checker(text, **self.bounds | {"radius": Fraction(0)})
        except NotProvedError:
            return False
        return True


class _Limits(NamedTuple):
    """Limits whose format `x` is "low < x < high"."""

    low: Fraction
    high: Fraction

    def __format__(self, name: str) -> str:
        return f"{_decimal(self.low)} < {name} < {_decimal(self.high)}"


def _decimal(value: Fraction) -> str:
    """Format an exact number without rounding: as a short decimal, or else as a fraction."""
    short = f"{float(value):g}", repr(float(value)), str(value)
    return next(text for text in short if Fraction(text) == value)


def _words(bounds: dict[str, Any]) -> dict[str, Any]:
    """Return what the text of a statement may name: bounds as text, and words for some of them."""
    words = dict(bounds)
    for name, value in bounds.items():
        if isinstance(value, Fraction):
            words[name] = _decimal(value)
        elif name == "window" and value:
            x, xdot = (_Limits(*limits) for limits in value)
            words[name] = f"{x:x} and {xdot:xdot}"
        elif isinstance(value, tuple) and isinstance(value[0], Fraction):
            words[name] = _Limits(*value)
    if "energy" in bounds:
        words["up_to"] = _highest_energy(bounds["k"], bounds["g"], bounds["energy"])
    if "type" in bounds:
        words["type"] = f"{'an' if bounds['type'][0] in 'ei' else 'a'} {bounds['type']}"
    if "period" in bounds:
        words |= _words_of_period(bounds["period"])
    if "halves" in bounds:
        words |= _words_of_grazing(**bounds)
    return words


def _words_of_period(period: int) -> dict[str, str]:
    """Return words for an elliptic orbit of a period and the invariant curves around it."""
    if period == 1:
        return {"power": "P", "orbit": "fixed point", "centre": "the elliptic fixed point",
                "discs": "the disc inside"}  # fmt: skip
    orbit = f"orbit of period {period}"
    return {"power": f"P^{period}", "orbit": orbit, "centre": f"a point of the elliptic {orbit}",
            "discs": "the disc inside and its images, which are disjoint"}  # fmt: skip


def _words_of_grazing(
    halves: tuple[events.Half, ...], periods: tuple[int, int], sides: tuple[int, int], **_: Any
) -> dict[str, str]:
    """Return how an orbit touches the floor, and the periods of the families that meet there."""
    touches = "twice per period, in a flight that is symmetric in time"
    if len(halves) == 1:
        meets = "meets" if halves[0][1] == "impact" else "does not meet"
        touches = f"once per period, while the ball is at rest, and {meets} y = 0"
    longer, shorter = (
        f"period {period} just {'above' if side > 0 else 'below'} this E"
        for period, side in zip(periods, sides, strict=True)
    )
    return {"touches": touches, "longer": longer, "shorter": shorter}


def _highest_energy(k: Fraction, g: Fraction, energy: Fraction) -> str:
    """Name a highest energy: by its formula if it is that of eq. (31) or of the first touch."""
    if energy == k / 2 - g:
        return "k/2 - g, eq. (31)"
    return ("g^2 (1 + k/2) = " if energy == g**2 * (1 + k / 2) else "") + _decimal(energy)


def _between(low: str, high: str) -> Range:
    return Fraction(low), Fraction(high)


def _window(x_low: str, x_high: str, xdot_low: str, xdot_high: str) -> Window:
    return _between(x_low, x_high), _between(xdot_low, xdot_high)


_FIG6_WINDOW = _window(*(str(edge) for axis in ("x", "xdot") for edge in values.WINDOW[axis]))
_ORBITS: dict[str, dict[str, Any]] = {
    name: dict(surface=surface, period=period, type=kind, radius=Fraction(radius), window=window)
    for name, surface, period, kind, radius, window in (
        ("fixed-point", FIG2, 1, "elliptic", "4e-3", _window("0.0212", "0.0213", "0.06", "0.0601")),
        ("fixed-point-low", FIG8, 1, "elliptic", "2e-3",
         _window("0.1325", "0.1326", "0.0389", "0.039")),
        ("six-elliptic", FIG2, 6, "elliptic", "1e-4",
         _window("-0.1519", "-0.1518", "0.0232", "0.0233")),
        ("six-hyperbolic", FIG2, 6, "hyperbolic", "1e-4", _FIG6_WINDOW),
        ("six-inverse", FIG2, 6, "inverse hyperbolic", "5e-4",
         _window("0.3869", "0.387", "0.0877", "0.0878")),
        ("ten-elliptic", FIG8, 10, "elliptic", "6e-6",
         _window("0.0141", "0.0142", "0.0226", "0.0227")),
        ("twelve-elliptic", FIG8, 12, "elliptic", "6e-6",
         _window("-0.0059", "-0.0058", "0.0159", "0.016")),
    )
}  # fmt: skip
_EXISTENCE = (
    "at E = {surface.energy} there is {type} orbit of period {period} with a point in {window}; no "
    "other of this period has its points, in order, within {radius} of these in x and in y"
)
_INVARIANT_CURVES = (
    "at E = {surface.energy} closed curves, invariant under {power}, surround the elliptic {orbit} "
    "with a point in {window} in each of its neighbourhoods: it is stable for all time, and they "
    "fill a positive area"
)

_INVARIANT_CURVE = (
    "at E = {surface.energy} there is an analytic curve, invariant under {power}, around {centre} "
    "with a point in {window}; on it {power} is conjugate to a rotation by omega clockwise, "
    "{rotation:omega}; it encloses more than {share} of the section, and no orbit ever enters or "
    "leaves {discs}"
)


def _elliptic(name: str) -> dict[str, Any]:
    """Return the bounds of an elliptic orbit."""
    return {bound: value for bound, value in _ORBITS[name].items() if bound != "type"}


def _curve(name: str, orbit: str, low: str, high: str, share: str, **hints: Any) -> Theorem:
    bounds = {"rotation": _between(low, high), "share": Fraction(share), "error": Fraction("1e-25")}
    return Theorem(name, _INVARIANT_CURVE, curve.check, _elliptic(orbit) | bounds, hints)


def _horseshoe(
    orbit: dict[str, Any], name: str, side: str, low: str, high: str, entropy: str, **hints: Any
) -> Theorem:
    """State that there is a horseshoe whose connection passes y = 0 between two x."""
    wording = (
        "at E = {surface.energy} the hyperbolic orbit of period {period} with a point in {window} "
        f"has a transversal connection, {side}, "
        "that passes y = 0 at {crossing:x}, and P has a uniformly hyperbolic invariant set that "
        "contains both, conjugate to a mixing subshift of entropy above {entropy}"
    )
    bounds = {"crossing": _between(low, high), "entropy": Fraction(entropy)}
    hints |= {"side": side}
    return Theorem(f"horseshoe-{name}", wording, horseshoe.check, orbit | bounds, hints)


_ENTROPY = (
    "at E = {surface.energy} P has a compact invariant set, on a neighbourhood of which it is "
    "analytic, with topological entropy above {entropy}"
)
_DOUBLING = (
    "at exactly one (E, x) within {radius} of that below, {energies:E} and {positions:x}, a "
    "symmetric orbit of period {period} meets y = 0 at x, and of its half orbit the derivative of "
    "x by x vanishes; along its family the trace falls through {trace} as E rises"
)
_GRAZING = (
    "at exactly one E within {radius} of that below, {energies:E}, an orbit touches the floor "
    "{touches}; there meet a family of symmetric orbits of {longer}, with an impact whose contact "
    "speed tends to zero, and one without it, of {shorter}"
)


def _grazing(
    name: str, halves: tuple[events.Half, ...], periods: tuple[int, int], sides: tuple[int, int],
    radius: str, low: str, high: str, near: tuple[str, ...],
) -> Theorem:  # fmt: skip
    bounds = dict(halves=halves, periods=periods, sides=sides, radius=Fraction(radius))
    bounds |= {"energies": _between(low, high)}
    return Theorem(name, _GRAZING, events.check_grazing, BALL | bounds, {"near": near})


_EVENTS = (
    Theorem(
        "six-birth",
        "at exactly one E, {energies:E}, the fixed point's rotation number is {rotation}; the "
        "twist is positive there, and near the point, at energies just above and at none just "
        "below, there are two symmetric orbits of period {period}, of which one meets y = 0",
        fixed_point.check_resonance,
        BALL | dict(
            rotation=Fraction("1/6"), period=6, energies=_between("0.007378", "0.007379")
        ),
    ),
    Theorem(
        "six-elliptic-doubling", _DOUBLING, events.check_doubling,
        BALL | dict(
            period=6, trace=-2, radius=Fraction("2e-10"),
            energies=_between("0.010825", "0.010826"), positions=_between("0.305", "0.306"),
        ),
        {"near": ("0.010825252768", "0.305443359319")},
    ),
    _grazing("six-elliptic-end", ((3, "impact"),), (6, 5), (-1, 1), "3e-5", "0.01252", "0.012521",
         near=("0.012520264234",)),
    _grazing("six-hyperbolic-end", ((2, "apex"), (0, "apex")), (6, 4), (-1, -1), "1e-4", "0.042726",
         "0.042727", near=("0.042726525978", "0.167175430477")),
    _grazing("six-inverse-birth", ((3, "apex"),), (7, 6), (-1, 1), "1e-5", "0.009682", "0.009683",
         near=("0.009682501945",)),
)  # fmt: skip
_SADDLES = {"surface": FIG2, "period": 6, "radius": Fraction("1e-4"), "window": _FIG6_WINDOW}
_SMOOTH_SADDLES = {
    "surface": _surface("3/2000"), "period": 14, "radius": Fraction("1e-6"),
    "window": _window("0.3821", "0.3822", "0.0384", "0.0385"),
}  # fmt: skip
_THEOREMS = (
    *(Theorem(name, _EXISTENCE, periodic.check, orbit) for name, orbit in _ORBITS.items()),
    Theorem(
        "one-fixed-point",
        "at each energy above the least, -g^2/(2k), up to {up_to}, the map has exactly one fixed "
        "point",
        fixed_point.check_unique,
        BALL | {"energy": LIMIT},
    ),
    Theorem(
        "fixed-point-elliptic",
        "at each energy above the least, -g^2/(2k), and up to {up_to}, the fixed point is "
        "elliptic; as E rises its trace falls strictly, to a value above {trace}, and its rotation "
        "number rises strictly from its limit zero",
        fixed_point.check_elliptic,
        BALL | {"energy": LIMIT, "trace": Fraction("-0.46")},
    ),
    *_EVENTS,
    _horseshoe(_SADDLES, "outer", "outer", "0.326", "0.327", "0.0185",
               plan=(59, 6.5e-5, 1.14)),
    _horseshoe(_SADDLES, "inner", "inner", "0.187", "0.188", "0.0083",
               plan=(177, 1e-10, 1.12)),
    _horseshoe(_SMOOTH_SADDLES, "smooth", "outer", "0.3895", "0.3896", "0.0128"),
    Theorem("entropy", _ENTROPY, graph.check, {"surface": FIG2, "entropy": Fraction("0.136")},
            {"periods": (6, 7, 8, 9), "size": 6e-3, "impacts": 12}),
    Theorem("entropy-lower", _ENTROPY, graph.check,
            {"surface": _surface("1/200"), "entropy": Fraction("0.05")},
            {"periods": (9, 10), "size": 2.5e-3, "impacts": 20}),
    Theorem(
        "no-circle",
        "at E = {surface.energy} the unstable manifold of the hyperbolic orbit of period {period} "
        "with a point in {window} meets the set on which P jumps; so no invariant circle on which "
        "P is continuous has a point of this orbit inside",
        jump.check_no_circle,
        _SADDLES,
    ),
    *(
        Theorem(f"twist-{name}", _INVARIANT_CURVES, twist.check, _elliptic(orbit))
        for name, orbit in (
            ("fixed-point", "fixed-point"), ("fixed-point-low", "fixed-point-low"),
            ("six", "six-elliptic"), ("ten", "ten-elliptic"), ("twelve", "twelve-elliptic"),
        )
    ),
    _curve("curve-fixed-point-outer", "fixed-point", "0.1688", "0.1689", "0.1578",
           quotients=(5, 1, 11), error="1e-26", strips=("0.0027", "0.000445", 320, 1, 1, 1640)),
    _curve("curve-six", "six-elliptic", "0.827", "0.8271", "0.0011", quotients=(1, 4, 1, 3),
           error="1e-30", strips=("0.02", "0.0033", 128, 4, 4, 330)),
    _curve("curve-fixed-point-low", "fixed-point-low", "0.1039", "0.104", "0.327", quotients=(9,),
           error="1e-30", strips=("0.025", "0.004", 256, 6, 4, 350)),
    Theorem(
        "twist-zero",
        "as E rises through the band below, the fixed point's twist changes from positive to "
        "negative, and where it is zero there the second twist is negative: below the first zero "
        "the normal form, truncated after it, has a circle without shear that shrinks into the "
        "point",
        twist.check_zero,
        BALL | {"radius": Fraction("2e-3"), "width": Fraction("1e-13")},
        {"energies": _between("0.029", "0.03")},
    ),
    Theorem(
        "twist-one-zero",
        "at each energy above the least, -g^2/(2k), and up to {up_to}, the fixed point is "
        "elliptic, and its multiplier lambda, lambda^2 and lambda^3 are not unity; lambda^4 is "
        "unity at one of these energies, the resonance, {resonance:E}; the twist is positive below "
        "one energy, the zero, {zero:E}, zero there, and negative above it; at all energies but "
        "these two, closed invariant curves surround the fixed point in each of its "
        "neighbourhoods, and it is stable for all time",
        one_zero.check,
        BALL | {
            "energy": LIMIT,
            "zero": _between("0.0291977581389", "0.0291977581390"),
            "resonance": _between("0.0373951", "0.0373952"),
        },
    ),
    Theorem(
        "unstable",
        "at exactly one E, {energies:E}, the fixed point's multiplier lambda has lambda^4 equal to "
        "unity; there |B| > |A| + {margin} in the normal form, and the fixed point is unstable: "
        "from each of its neighbourhoods orbits leave one and the same neighbourhood",
        fixed_point.check_unstable,
        BALL | {
            "energies": _between("0.0373951713626", "0.0373951713627"), "margin": Fraction("5.6"),
        },
    ),
    Theorem(
        "jump-set",
        "at E = {surface.energy} P is not continuous, hence not a diffeomorphism: at one point its "
        "one-sided limits are more than {jump} apart; the points where it jumps are one smooth "
        "curve longer than {length} in (x, y), from the rim to an inner end",
        jump.check,
        {"surface": FIG2, "radius": Fraction("1e-28"), "length": Fraction("0.4048"),
         "jump": Fraction("0.27")},
        {"speed": "0.02"},
    ),
    Theorem(
        "diffeomorphism",
        "at every E below {up_to} P is analytic on the open disk of the section, with the analytic "
        "inverse R P R",
        jump.check_smooth,
        BALL | {"energy": BALL["g"] ** 2 * (1 + BALL["k"] / 2)},
    ),
)  # fmt: skip
THEOREMS = {theorem.name: theorem for theorem in _THEOREMS}


def theorem_verdict(theorem: str) -> xr.Dataset:
    """Check a theorem from its certificate.

    The dataset has no variable. Its attributes are verdict, "proved" or "not proved", and line, all
    of the result in one line.
    """
    result = THEOREMS[theorem].check()
    return xr.Dataset(attrs={"verdict": result.verdict, "line": result.line()})
