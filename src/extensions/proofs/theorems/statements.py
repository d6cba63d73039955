"""The theorems at the paper's numbers, k = 1/5 and g = 1/25, with their checkers.

result = THEOREMS["horseshoe-outer"].check()
result.verdict, result.reason, result.digits      # "proved", "", {"entropy": "[0.018... "]}
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from importlib import resources

import xarray as xr

from pipeline.loading import note_loaded
from pseudorigid.dynamics import paper
from study.enclosure.flight import NotProvedError
from study.enclosure.surface import Surface

from ..checks import (
    curve,
    ellipticity,
    events,
    graph,
    horseshoe,
    instability,
    jump,
    no_circle,
    one_zero,
    periodic,
    twist,
)
from ..checks.certificate import Finding
from ..checks.periodic import Window

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
    wording: str | Callable[..., str]  # a function takes the bounds and writes each number of them
    checker: Callable[..., Finding]  # takes a certificate's text and the bounds
    bounds: dict
    hints: dict = field(default_factory=dict)  # arguments of the search for a certificate

    @property
    def statement(self) -> str:
        """The statement in words, with the numbers that the checker is given."""
        text = self.wording if isinstance(self.wording, str) else self.wording(**self.bounds)
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
            note_loaded(folder / self.certificate, data)
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


Range = tuple[Fraction, Fraction]


def _between(low: str, high: str) -> Range:
    return Fraction(low), Fraction(high)


def _window(x_low: str, x_high: str, xdot_low: str, xdot_high: str) -> Window:
    return _between(x_low, x_high), _between(xdot_low, xdot_high)


def _decimal(value: Fraction) -> str:
    """Format an exact number without rounding: as a short decimal, or else as a fraction."""
    short = f"{float(value):g}", repr(float(value)), str(value)
    return next(text for text in short if Fraction(text) == value)


def _inside(name: str, limits: Range) -> str:
    """Format limits as inequalities."""
    return f"{_decimal(limits[0])} < {name} < {_decimal(limits[1])}"


def _region(window: Window) -> str:
    """Format a window as inequalities of x and xdot."""
    return f"{_inside('x', window[0])} and {_inside('xdot', window[1])}"


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


def _existence(*, surface, period, type, radius, window) -> str:
    """State that an orbit exists, is the only one near its points, and has one in the window."""
    article = "an" if type[0] in "ei" else "a"
    return (
        f"at E = {surface.energy} there is {article} {type} orbit of period {period} with a point "
        f"in {_region(window)}; no other of this period has its points, in order, within "
        f"{_decimal(radius)} of these in x and in y"
    )


def _up_to(k: Fraction, g: Fraction, energy: Fraction) -> str:
    """Name a highest energy: by its formula if it is that of eq. (31)."""
    return "k/2 - g, eq. (31)" if energy == k / 2 - g else _decimal(energy)


def _one_fixed_point(*, k, g, energy) -> str:
    return (
        f"at each energy above the least, -g^2/(2k), up to {_up_to(k, g, energy)}, the map has "
        "exactly one fixed point"
    )


def _elliptic_fixed_point(*, k, g, energy, trace) -> str:
    return (
        f"at each energy above the least, -g^2/(2k), and up to {_up_to(k, g, energy)}, the fixed "
        "point is elliptic; as E rises its trace falls strictly, to a value above "
        f"{_decimal(trace)}, and its rotation number rises strictly from its limit zero"
    )


def _return_map(period: int) -> str:
    return f"P^{period}" if period > 1 else "P"


def _invariant_curves(*, surface, period, radius, window) -> str:
    """State that invariant curves surround an elliptic orbit."""
    kind = f"orbit of period {period}" if period > 1 else "fixed point"
    return (
        f"at E = {surface.energy} closed curves, invariant under {_return_map(period)}, surround "
        f"the elliptic {kind} with a point in {_region(window)} in each of its neighbourhoods: it "
        "is stable for all time, and they fill a positive area"
    )


def _elliptic(name: str) -> dict:
    """Return the bounds of an elliptic orbit."""
    return {bound: value for bound, value in _ORBITS[name].items() if bound != "type"}


def _twist(name: str, orbit: str) -> Theorem:
    return Theorem(name, _invariant_curves, twist.check, _elliptic(orbit))


def _invariant_curve(*, surface, period, radius, window, rotation, share, error) -> str:
    """State that an invariant curve encloses a share of the section."""
    power = _return_map(period)
    around, discs = "the elliptic fixed point", "the disc inside"
    if period > 1:
        around = f"a point of the elliptic orbit of period {period}"
        discs = "the disc inside and its images, which are disjoint"
    return (
        f"at E = {surface.energy} there is an analytic curve, invariant under {power}, around "
        f"{around} with a point in {_region(window)}; on it {power} is conjugate to a rotation by "
        f"omega clockwise, {_inside('omega', rotation)}; it encloses more than {_decimal(share)} "
        f"of the section, and no orbit ever enters or leaves {discs}"
    )


def _curve(name: str, orbit: str, low: str, high: str, share: str, **hints) -> Theorem:
    bounds = {"rotation": _between(low, high), "share": Fraction(share), "error": Fraction("1e-25")}
    return Theorem(name, _invariant_curve, curve.check, _elliptic(orbit) | bounds, hints)


def _horseshoe(
    orbit: dict, name: str, side: str, low: str, high: str, entropy: str, **hints
) -> Theorem:
    """State that there is a horseshoe whose connection passes y = 0 between two x."""

    def wording(*, surface, period, radius, window, crossing, entropy) -> str:
        return (
            f"at E = {surface.energy} the hyperbolic orbit of period {period} with a point in "
            f"{_region(window)} has a transversal connection, {side}, that passes y = 0 at "
            f"{_inside('x', crossing)}, and P has a uniformly hyperbolic invariant set that "
            "contains both, conjugate to a mixing subshift of entropy above "
            f"{_decimal(entropy)}"
        )

    bounds = {"crossing": _between(low, high), "entropy": Fraction(entropy)}
    hints |= {"side": side}
    return Theorem(f"horseshoe-{name}", wording, horseshoe.check, orbit | bounds, hints)


def _entropy(name: str, surface: Surface, entropy: str, **hints) -> Theorem:
    """State that the topological entropy is above a number, in nats per impact."""

    def wording(*, surface, entropy) -> str:
        return (
            f"at E = {surface.energy} P has a compact invariant set, on a neighbourhood of which "
            f"it is analytic, with topological entropy above {_decimal(entropy)}"
        )

    bounds = {"surface": surface, "entropy": Fraction(entropy)}
    return Theorem(name, wording, graph.check, bounds, hints)


def _no_circle(*, surface, period, radius, window) -> str:
    return (
        f"at E = {surface.energy} the unstable manifold of the hyperbolic orbit of period {period} "
        f"with a point in {_region(window)} meets the set on which P jumps; so no invariant circle "
        "on which P is continuous has a point of this orbit inside"
    )


def _birth(*, k, g, rotation, period, energies) -> str:
    return (
        f"at exactly one E, {_inside('E', energies)}, the fixed point's rotation number is "
        f"{rotation}; the twist is positive there, and near the point, at energies just above and "
        f"at none just below, there are two symmetric orbits of period {period}, of which one "
        "meets y = 0"
    )


def _doubling(*, k, g, period, trace, radius, energies, positions) -> str:
    return (
        f"at exactly one (E, x) within {_decimal(radius)} of that below, {_inside('E', energies)} "
        f"and {_inside('x', positions)}, a symmetric orbit of period {period} meets y = 0 at x, "
        "and of its half orbit the derivative of x by x vanishes; along its family the trace falls "
        f"through {trace} as E rises"
    )


def _grazing(*, k, g, halves, periods, sides, radius, energies) -> str:
    """State that an orbit with a grazing impact exists at one energy, and what meets there."""
    touches = "twice per period, in a flight that is symmetric in time"
    if len(halves) == 1:
        meets = "meets" if halves[0][1] == "impact" else "does not meet"
        touches = f"once per period, while the ball is at rest, and {meets} y = 0"
    longer, shorter = (
        f"period {period} just {'above' if side > 0 else 'below'} this E"
        for period, side in zip(periods, sides, strict=True)
    )
    return (
        f"at exactly one E within {_decimal(radius)} of that below, {_inside('E', energies)}, an "
        f"orbit touches the floor {touches}; there meet a family of symmetric orbits of {longer}, "
        f"with an impact whose contact speed tends to zero, and one without it, of {shorter}"
    )


def _end(
    name: str, halves: tuple, periods: tuple[int, int], sides: tuple[int, int],
    radius: str, low: str, high: str, near: tuple[str, ...],
) -> Theorem:  # fmt: skip
    bounds = dict(halves=halves, periods=periods, sides=sides, radius=Fraction(radius))
    bounds |= {"energies": _between(low, high)}
    return Theorem(name, _grazing, events.check_grazing, BALL | bounds, {"near": near})


def _one_zero(*, k, g, energy, zero, resonance) -> str:
    return (
        f"at each energy above the least, -g^2/(2k), and up to {_up_to(k, g, energy)}, the fixed "
        "point is elliptic, and its multiplier lambda, lambda^2 and lambda^3 are not unity; "
        f"lambda^4 is unity at one of these energies, the resonance, {_inside('E', resonance)}; "
        f"the twist is positive below one energy, the zero, {_inside('E', zero)}, zero there, and "
        "negative above it; at all energies but these two, closed invariant curves surround the "
        "fixed point in each of its neighbourhoods, and it is stable for all time"
    )


def _unstable(*, k, g, energies, margin) -> str:
    return (
        f"at exactly one E, {_inside('E', energies)}, the fixed point's multiplier lambda has "
        f"lambda^4 equal to unity; there |B| > |A| + {_decimal(margin)} in the normal form, and "
        "the fixed point is unstable: from each of its neighbourhoods orbits leave one and the "
        "same neighbourhood"
    )


def _jump_set(*, surface, radius, length, jump) -> str:
    return (
        f"at E = {surface.energy} P is not continuous at the point below, where its one-sided "
        f"limits are more than {_decimal(jump)} apart, and not a diffeomorphism; the points where "
        f"it jumps are one smooth curve longer than {_decimal(length)} in (x, y), from the rim to "
        "an inner end"
    )


def _diffeomorphism(*, k, g, energy) -> str:
    formula = "g^2 (1 + k/2) = " if energy == g**2 * (1 + k / 2) else ""
    return (
        f"at every E below {formula}{_decimal(energy)} P is analytic on the open disk of the "
        "section, with the analytic inverse R P R"
    )


_EVENTS = (
    Theorem(
        "six-birth", _birth, events.check_resonance,
        BALL | dict(
            rotation=Fraction("1/6"), period=6, energies=_between("0.007378", "0.007379")
        ),
    ),
    Theorem(
        "six-elliptic-doubling", _doubling, events.check_doubling,
        BALL | dict(
            period=6, trace=-2, radius=Fraction("2e-10"),
            energies=_between("0.010825", "0.010826"), positions=_between("0.305", "0.306"),
        ),
        {"near": ("0.010825252768", "0.305443359319")},
    ),
    _end("six-elliptic-end", ((3, "impact"),), (6, 5), (-1, 1), "3e-5", "0.01252", "0.012521",
         near=("0.012520264234",)),
    _end("six-hyperbolic-end", ((2, "apex"), (0, "apex")), (6, 4), (-1, -1), "1e-4", "0.042726",
         "0.042727", near=("0.042726525978", "0.167175430477")),
    _end("six-inverse-birth", ((3, "apex"),), (7, 6), (-1, 1), "1e-5", "0.009682", "0.009683",
         near=("0.009682501945",)),
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
_UNSTABLE = {
    "energies": _between("0.0373951713626", "0.0373951713627"), "margin": Fraction("5.6"),
}  # fmt: skip
_THRESHOLD = BALL["g"] ** 2 * (1 + BALL["k"] / 2)
_THEOREMS = (
    *(Theorem(name, _existence, periodic.check, orbit) for name, orbit in _ORBITS.items()),
    Theorem("one-fixed-point", _one_fixed_point, periodic.check_only_fixed_point,
            BALL | {"energy": LIMIT}),
    Theorem("fixed-point-elliptic", _elliptic_fixed_point, ellipticity.check,
            BALL | {"energy": LIMIT, "trace": Fraction("-0.46")}),
    *_EVENTS,
    _horseshoe(_SADDLES, "outer", "outer", "0.326", "0.327", "0.0185",
               plan=(59, 6.5e-5, 1.14)),
    _horseshoe(_SADDLES, "inner", "inner", "0.187", "0.188", "0.0083",
               plan=(177, 1e-10, 1.12)),
    _horseshoe(_SMOOTH_SADDLES, "smooth", "outer", "0.3895", "0.3896", "0.0128"),
    _entropy("entropy", HIGH, "0.136", periods=(6, 7, 8, 9), size=6e-3, impacts=12),
    _entropy("entropy-lower", Surface(**BALL, energy="1/200"), "0.05",
             periods=(9, 10), size=2.5e-3, impacts=20),
    Theorem("no-circle", _no_circle, no_circle.check, _SADDLES),
    _twist("twist-fixed-point", "fixed-point"),
    _twist("twist-fixed-point-low", "fixed-point-low"),
    _twist("twist-six", "six-elliptic"),
    _twist("twist-ten", "ten-elliptic"),
    _twist("twist-twelve", "twelve-elliptic"),
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
        "twist-one-zero", _one_zero, one_zero.check,
        BALL | {
            "energy": LIMIT,
            "zero": _between("0.0291977581389", "0.0291977581390"),
            "resonance": _between("0.0373951", "0.0373952"),
        },
    ),
    Theorem("unstable", _unstable, instability.check, BALL | _UNSTABLE),
    Theorem("jump-set", _jump_set, jump.check, _JUMPS, {"speed": "0.02"}),
    Theorem("diffeomorphism", _diffeomorphism, jump.check_smooth, BALL | {"energy": _THRESHOLD}),
)  # fmt: skip
THEOREMS = {theorem.name: theorem for theorem in _THEOREMS}


def theorem_verdict(theorem: str) -> xr.Dataset:
    """Check a theorem from its certificate.

    The dataset has no variable. Its attributes are verdict, "proved" or "not proved", and line, all
    of the result in one line.
    """
    result = THEOREMS[theorem].check()
    return xr.Dataset(attrs={"verdict": result.verdict, "line": result.line()})
