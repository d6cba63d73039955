"""The theorems at the paper's numbers, k = 1/5 and g = 1/25, with their checkers.

result = THEOREMS["horseshoe-outer"].check()
result.verdict, result.reason, result.digits      # "proved", "", {"entropy": "[0.018... "]}
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from importlib import resources

import xarray as xr

import pseudorigid

from ...dynamics import paper
from ..checks import (
    curve,
    ellipticity,
    events,
    graph,
    horseshoe,
    jump,
    no_circle,
    one_zero,
    periodic,
    twist,
)
from ..checks.certificate import Finding
from ..checks.periodic import Window
from ..enclosure.flight import NotProvedError
from ..enclosure.surface import Surface

BALL = {name: Fraction(str(paper.BALL[name])) for name in "kg"}
HIGH, LOW = Surface(**BALL, energy="1/100"), Surface(**BALL, energy="1/1000")
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
    seconds: float  # duration of the check

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
        parts += [f"{self.seconds:.2f} s", self.reason, self.verdict]
        return "; ".join(part for part in parts if part)


@dataclass(frozen=True)
class Theorem:
    """A statement, and its checker with the statement's numbers, which are exact."""

    name: str
    statement: str
    checker: Callable[..., Finding]  # takes a certificate's text and the bounds
    bounds: dict
    hints: dict = field(default_factory=dict)  # arguments of the search for a certificate

    @property
    def certificate(self) -> str:
        """Name of the certificate's file in the folder `certificates`."""
        return f"{self.name}.toml"

    def text(self) -> str:
        """Read the package's own certificate."""
        folder = resources.files(__package__.rpartition(".")[0]) / "certificates"
        data = (folder / self.certificate).read_bytes()
        pseudorigid.note_loaded(folder / self.certificate, data)
        return data.decode("utf-8")

    def prove(self, text: str | None = None) -> Finding:
        """Run the checker on a certificate, by default the package's own.

        Raises NotProvedError.
        """
        return self.checker(self.text() if text is None else text, **self.bounds)

    def check(self, text: str | None = None) -> Result:
        """Return the verdict on a certificate, by default the package's own."""
        begin, finding, reason = time.perf_counter(), Finding(), ""
        try:
            finding = self.prove(text)
        except FileNotFoundError:
            reason = "there is no such certificate"
        except NotProvedError as error:
            reason = " ".join(str(error).split()) or "no reason is given"
        digits = {name: value.str(MOST_DIGITS) for name, value in finding.digits.items()}
        about = self.name, self.statement, self.certificate, reason
        return Result(*about, digits, finding.margins, time.perf_counter() - begin)

    def holds_for_any_radius(self, text: str) -> bool:
        """Whether the checker accepts a certificate whatever radius it claims."""
        try:
            self.checker(text, **self.bounds | {"radius": Fraction(0)})
        except NotProvedError:
            return False
        return True


Range = tuple[Fraction, Fraction]


def _between(low: str, high: str) -> Range:
    return Fraction(low), Fraction(high)


def _window(x_low: str, x_high: str, xdot_low: str, xdot_high: str) -> Window:
    return _between(x_low, x_high), _between(xdot_low, xdot_high)


def _region(window: Window) -> str:
    """Format a window as inequalities of x and xdot."""
    sides = zip(("x", "xdot"), window, strict=True)
    return " and ".join(f"{float(a):g} < {name} < {float(b):g}" for name, (a, b) in sides)


_FIGURE_6 = _window(*(str(edge) for axis in ("x", "xdot") for edge in paper.WINDOW[axis]))
_ORBITS = {
    name: dict(surface=surface, period=period, type=kind, radius=Fraction(radius), window=window)
    for name, surface, period, kind, radius, window in (
        ("fixed-point", HIGH, 1, "elliptic", "4e-3", _window("0.0212", "0.0213", "0.06", "0.0601")),
        ("fixed-point-low", LOW, 1, "elliptic", "2e-3",
         _window("0.1325", "0.1326", "0.0389", "0.039")),
        ("six-elliptic", HIGH, 6, "elliptic", "1e-4",
         _window("-0.1519", "-0.1518", "0.0232", "0.0233")),
        ("six-hyperbolic", HIGH, 6, "hyperbolic", "1e-4", _FIGURE_6),
        ("six-inverse", HIGH, 6, "inverse hyperbolic", "5e-4",
         _window("0.3869", "0.387", "0.0877", "0.0878")),
        ("ten-elliptic", LOW, 10, "elliptic", "6e-6",
         _window("0.0141", "0.0142", "0.0226", "0.0227")),
        ("twelve-elliptic", LOW, 12, "elliptic", "6e-6",
         _window("-0.0059", "-0.0058", "0.0159", "0.016")),
    )
}  # fmt: skip


def _existence(name: str, orbit: dict) -> Theorem:
    """State that an orbit exists, is the only one near its points, and has one in the window."""
    kind = orbit["type"]
    article = "an" if kind[0] in "ei" else "a"
    statement = (
        f"at E = {orbit['surface'].energy} there is {article} {kind} orbit of period "
        f"{orbit['period']} with a point in {_region(orbit['window'])}; no other of this period "
        f"has its points, in order, within {float(orbit['radius']):g} of these in x and in y"
    )
    return Theorem(name, statement, periodic.check, orbit)


def _invariant_curves(name: str, orbit: str) -> Theorem:
    """State that invariant curves surround an elliptic orbit."""
    bounds, power, point = _elliptic(orbit)
    kind = f"orbit of period {bounds['period']}" if bounds["period"] > 1 else "fixed point"
    statement = (
        f"at E = {bounds['surface'].energy} closed curves, invariant under {power}, surround the "
        f"elliptic {kind} with {point} in each of its neighbourhoods: it is stable for all time, "
        "and they fill a positive area"
    )
    return Theorem(name, statement, twist.check, bounds)


def _elliptic(name: str) -> tuple[dict, str, str]:
    """Return the bounds of an elliptic orbit, its return map, and which point it has."""
    bounds = {bound: value for bound, value in _ORBITS[name].items() if bound != "type"}
    power = f"P^{bounds['period']}" if bounds["period"] > 1 else "P"
    return bounds, power, f"a point in {_region(bounds['window'])}"


def _curve(name: str, orbit: str, low: str, high: str, share: str, **hints) -> Theorem:
    """State that an invariant curve encloses a share of the section."""
    bounds, power, point = _elliptic(orbit)
    around, discs = "the elliptic fixed point", "the disc inside"
    if bounds["period"] > 1:
        around = f"a point of the elliptic orbit of period {bounds['period']}"
        discs = "the disc inside and its images, which are disjoint"
    statement = (
        f"at E = {bounds['surface'].energy} there is an analytic curve, invariant under {power}, "
        f"around {around} with {point}; on it {power} is conjugate to a rotation by omega "
        f"clockwise, {low} < omega < {high}; it encloses more than {share} of the section, and no "
        f"orbit ever enters or leaves {discs}"
    )
    bounds |= {"rotation": _between(low, high), "share": Fraction(share)}
    return Theorem(name, statement, curve.check, bounds | {"error": Fraction("1e-36")}, hints)


def _horseshoe(
    orbit: dict, name: str, side: str, low: str, high: str, entropy: str, **hints
) -> Theorem:
    """State that there is a horseshoe whose connection passes y = 0 between two x."""
    statement = (
        f"at E = {orbit['surface'].energy} the hyperbolic orbit of period {orbit['period']} with a "
        f"point in {_region(orbit['window'])} has a transversal connection, {side}, that passes "
        f"y = 0 at {low} < x < {high}, and P has a uniformly hyperbolic invariant set that "
        f"contains both, conjugate to a mixing subshift of entropy above {entropy}"
    )
    bounds = {"crossing": _between(low, high), "entropy": Fraction(entropy)}
    hints |= {"side": side}
    return Theorem(f"horseshoe-{name}", statement, horseshoe.check, orbit | bounds, hints)


def _entropy(name: str, surface: Surface, entropy: str, **hints) -> Theorem:
    """State that the topological entropy is above a number, in nats per impact."""
    statement = (
        f"at E = {surface.energy} P has a compact invariant set, on a neighbourhood of which it is "
        f"analytic, with topological entropy above {entropy}"
    )
    bounds = {"surface": surface, "entropy": Fraction(entropy)}
    return Theorem(name, statement, graph.check, bounds, hints)


def _grazing(
    name: str, text: str, halves: tuple, periods: tuple[int, int], sides: tuple[int, int],
    radius: str, low: str, high: str, near: tuple[str, ...],
) -> Theorem:  # fmt: skip
    """State that an orbit with a grazing impact exists at one energy, and what meets there."""
    longer, shorter = (
        f"period {period} just {'above' if side > 0 else 'below'} this E"
        for period, side in zip(periods, sides, strict=True)
    )
    statement = (
        f"at exactly one E within {float(radius):g} of that below, {low} < E < {high}, {text}; "
        f"there meet a family of symmetric orbits of {longer}, with an impact whose contact speed "
        f"tends to zero, and one without it, of {shorter}"
    )
    bounds = dict(halves=halves, periods=periods, sides=sides, radius=Fraction(radius))
    bounds |= {"energies": _between(low, high)}
    return Theorem(name, statement, events.check_grazing, BALL | bounds, {"near": near})


_EVENTS = (
    Theorem(
        "six-birth",
        "at exactly one E, 0.007378 < E < 0.007379, the fixed point's rotation number is 1/6; the "
        "twist is positive there, and near the point, at energies just above and at none just "
        "below, there are two symmetric orbits of period 6, of which one meets y = 0",
        events.check_resonance,
        BALL | dict(
            rotation=Fraction("1/6"), period=6, energies=_between("0.007378", "0.007379")
        ),
    ),
    Theorem(
        "six-elliptic-doubling",
        "at exactly one (E, x) within 2e-10 of that below, 0.010825 < E < 0.010826 and "
        "0.305 < x < 0.306, a symmetric orbit of period 6 meets y = 0 at x, and of its half orbit "
        "the derivative of x by x vanishes; along its family the trace falls through -2 as E rises",
        events.check_doubling,
        BALL | dict(
            period=6, trace=-2, radius=Fraction("2e-10"),
            energies=_between("0.010825", "0.010826"), positions=_between("0.305", "0.306"),
        ),
        {"near": ("0.010825252768", "0.305443359319")},
    ),
    _grazing(
        "six-elliptic-end",
        "an orbit touches the floor once per period, while the ball is at rest, and meets y = 0",
        ((3, "impact"),), (6, 5), (-1, 1), "3e-5", "0.01252", "0.012521",
        near=("0.012520264234",),
    ),
    _grazing(
        "six-hyperbolic-end",
        "an orbit touches the floor twice per period, in a flight that is symmetric in time",
        ((2, "apex"), (0, "apex")), (6, 4), (-1, -1), "1e-4", "0.042726", "0.042727",
        near=("0.042726525978", "0.167175430477"),
    ),
    _grazing(
        "six-inverse-birth",
        "an orbit touches the floor once per period, while the ball is at rest, and does not meet "
        "y = 0",
        ((3, "apex"),), (7, 6), (-1, 1), "1e-5", "0.009682", "0.009683",
        near=("0.009682501945",),
    ),
)  # fmt: skip
_SADDLES = {"surface": HIGH, "period": 6, "radius": Fraction("1e-4"), "window": _FIGURE_6}
_SMOOTH_SADDLES = {
    "surface": Surface(**BALL, energy="3/2000"), "period": 14, "radius": Fraction("1e-6"),
    "window": _window("0.3821", "0.3822", "0.0384", "0.0385"),
}  # fmt: skip
_JUMPS = {
    "surface": HIGH, "radius": Fraction("1e-28"), "length": Fraction("0.4048"),
    "jump": Fraction("0.27"),
}  # fmt: skip
_THRESHOLD = BALL["g"] ** 2 * (1 + BALL["k"] / 2)
_TRACE = Fraction("-0.46")  # below the fixed point's at the highest energy
_THEOREMS = (
    *(_existence(name, orbit) for name, orbit in _ORBITS.items()),
    Theorem(
        "one-fixed-point",
        "at each energy above the least, -g^2/(2k), up to k/2 - g, eq. (31), the map has exactly "
        "one fixed point",
        periodic.check_only_fixed_point,
        BALL | {"energy": LIMIT},
    ),
    Theorem(
        "fixed-point-elliptic",
        "at each energy above the least, -g^2/(2k), and up to k/2 - g, eq. (31), the fixed point "
        "is elliptic; as E rises its trace falls strictly, to a value above "
        f"{float(_TRACE):g}, and its rotation number rises strictly from its limit zero",
        ellipticity.check,
        BALL | {"energy": LIMIT, "trace": _TRACE},
    ),
    *_EVENTS,
    _horseshoe(_SADDLES, "outer", "outer", "0.326", "0.327", "0.0185",
               plan=(59, 6.5e-5, 1.14)),
    _horseshoe(_SADDLES, "inner", "inner", "0.187", "0.188", "0.0083",
               plan=(177, 1e-10, 1.12)),
    _horseshoe(_SMOOTH_SADDLES, "smooth", "outer", "0.3895", "0.3896", "0.0128"),
    _entropy("entropy", HIGH, "0.136", periods=(6, 7, 8, 9), size=6e-3, impacts=12),
    _entropy("entropy-lower", Surface(**BALL, energy="1/200"), "0.05",
             periods=(9, 10), size=2.5e-3, impacts=20),
    Theorem(
        "no-circle",
        f"at E = {HIGH.energy} the unstable manifold of the hyperbolic orbit of period 6 with a "
        f"point in {_region(_FIGURE_6)} meets the set on which P jumps; so no invariant circle on "
        "which P is continuous has a point of this orbit inside",
        no_circle.check,
        _SADDLES,
    ),
    _invariant_curves("twist-fixed-point", "fixed-point"),
    _invariant_curves("twist-fixed-point-low", "fixed-point-low"),
    _invariant_curves("twist-six", "six-elliptic"),
    _invariant_curves("twist-ten", "ten-elliptic"),
    _invariant_curves("twist-twelve", "twelve-elliptic"),
    _curve("curve-fixed-point", "fixed-point", "0.1729", "0.173", "0.117", quotients=(5, 1, 3),
           error="1e-37", strips=("0.025", "0.004", 256, 6, 6, 380)),
    _curve("curve-fixed-point-outer", "fixed-point", "0.1703", "0.1704", "0.15",
           quotients=(5, 1, 6), error="1e-38", strips=("0.0125", "0.002", 512, 6, 4, 1020)),
    _curve("curve-six", "six-elliptic", "0.827", "0.8271", "0.0011", quotients=(1, 4, 1, 3),
           error="5e-45", strips=("0.02", "0.0033", 128, 5, 5, 540)),
    _curve("curve-fixed-point-low", "fixed-point-low", "0.1039", "0.104", "0.327", quotients=(9,),
           error="1e-37", strips=("0.025", "0.004", 512, 10, 6, 440)),
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
        "at each energy above the least, -g^2/(2k), and up to k/2 - g, eq. (31), the fixed point "
        "is elliptic, and its multiplier lambda, lambda^2 and lambda^3 are not unity; lambda^4 is "
        "unity at one of these energies, the resonance below; the twist is positive below one "
        "energy, the zero below, zero there, and negative above it; at all energies but these two, "
        "closed invariant curves surround the fixed point in each of its neighbourhoods, and it is "
        "stable for all time",
        one_zero.check,
        BALL
        | {
            "energy": LIMIT,
            "zero": _between("0.0291977581389", "0.0291977581390"),
            "resonance": _between("0.0373951", "0.0373952"),
        },
    ),
    Theorem(
        "jump-set",
        f"at E = {HIGH.energy} P is not continuous at the point below, where its one-sided limits "
        f"are more than {float(_JUMPS['jump']):g} apart, and not a diffeomorphism; "
        f"the points where it jumps are one smooth curve longer than {float(_JUMPS['length']):g} "
        "in (x, y), from the rim to an inner end",
        jump.check,
        _JUMPS,
        {"speed": "0.02"},
    ),
    Theorem(
        "diffeomorphism",
        f"at every E below g^2 (1 + k/2) = {float(_THRESHOLD):g} P is analytic on the "
        "open disk of the section, with the analytic inverse R P R",
        jump.check_smooth,
        BALL | {"energy": _THRESHOLD},
    ),
)  # fmt: skip
THEOREMS = {theorem.name: theorem for theorem in _THEOREMS}


def theorem_verdict(name: str) -> xr.Dataset:
    """Check a theorem from its certificate.

    The dataset has no variable. Its attributes are verdict, "proved" or "not proved", reason, which
    is empty if it is proved, and statement.
    """
    result = THEOREMS[name].check()
    attributes = {"verdict": result.verdict, "reason": result.reason}
    return xr.Dataset(attrs=attributes | {"statement": result.statement})
