"""Kinds of picture behind the verdicts on the paper's statements."""

from collections.abc import Iterator
from typing import Annotated

from annotated_types import Predicate

from extensions.proofs.kinds import Curves
from paper.groups import OfOrbits, OfRecords, bounded, is_sound, not_elliptic
from pipeline.config.schema.fields import ABSENT, LARGEST, Fraction, Name, allowed, rising, whole
from pipeline.config.schema.scene import CrossFieldError, Picture, Scene
from pseudorigid.kernel.closed_forms import twice_energy_above_rest

from .fields import Between, Energies, OfSea


class Spread(OfRecords):
    """Lyapunov exponents of many orbits at many lengths"""

    stages = ("spread", "lyapunov")
    headline = "long-run exponent"

    orbits: int = whole(2, 1000)
    """Number of long orbits, which start uniformly over the whole section. Their exponents decide
    which of them are chaotic."""
    length: int = whole(100, 100_000_000)
    """Number of impacts of each long orbit, a multiple of `blocks`."""
    blocks: int = whole(2, 10_000)
    """Number of equal blocks of a long orbit, the shortest runs whose exponents are kept."""
    regular: list[Fraction] = allowed("a list of fractions", min_length=1)
    """Starts of regular orbits, as fractions of the section's radius along y = 0, whose exponents
    are drawn beside ln n/n."""
    regular_impacts: int = whole(16, 10_000_000)
    """Number of impacts of each regular orbit."""
    cells: int = whole(2, 1000)
    """Number of cells to a side, in the rectangle around the section, of which those that chaotic
    orbits enter are counted."""
    visits: int = whole(2, 100_000_000)
    """Number of impacts of each chaotic orbit whose cells are counted."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the length is a multiple of the blocks."""
        yield from super().cross_field_errors()
        if self.length % self.blocks:
            yield ("blocks",), self.blocks, f"a divisor of length = {self.length}"


class Clusters(OfSea):
    """clusters of impacts and their memory"""

    stages = ("clusters",)
    headline = "time between clusters"

    cuts: list[Annotated[float, allowed("a time above 0", gt=0)]] = allowed(
        "a list of 1 to 7 times", min_length=1, max_length=7
    )
    """Times, in 1/omega. A flight longer than a cut separates two clusters of impacts. A run
    refuses a cut that leaves no orbit lags + 2 clusters, and names the largest possible one."""
    lags: int = whole(1, 100)
    """A cluster is compared with this many later ones."""
    resamples: int = whole(10, 100_000)
    """Bootstrap samples of whole orbits for each 95 % confidence interval; a few hundred do."""
    seed: int = whole(0, 2**31)
    """Random seed of the bootstrap, which decides the ends of the confidence intervals and nothing
    else."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that all fits into memory, and that cuts are below the longest flight."""
        yield from super().cross_field_errors()
        yield from bounded(self, "orbits", "resamples", "orbits drawn")
        yield from bounded(self, "orbits", "impacts", "impacts in all", 10 * LARGEST)
        if self.lags > self.impacts - 2:
            yield ("lags",), self.lags, f"at most impacts - 2 = {self.impacts - 2}"
        if not is_sound(self):
            return
        (k, g), energy = (self.ball.k, self.ball.g), self.energy
        longest = 2 * twice_energy_above_rest(k, g, energy) ** 0.5 / g
        for i, cut in enumerate(self.cuts):
            if not cut < longest:
                words = f"a time below {longest:.4g}, which no flight at this energy exceeds"
                yield ("cuts", i), cut, words


class Rotation(Scene):
    """rotation number and exponent against the start"""

    stages = ("rotation",)
    headline = "at the fixed point"

    energies: Energies
    """Energies whose rotation numbers are drawn beside those of `energy`."""
    starts: int = whole(2, 100_000)
    """Number of orbits at each energy. They start evenly along y = 0, from the fixed point to the
    rim."""
    impacts: int = whole(100, 10_000_000)
    """Number of impacts of each orbit."""
    detail: Between
    """Part of the symmetry line y = 0 that is drawn at higher resolution, in section radii from the
    section's centre: `starts` further orbits start evenly in it, at `energy`."""
    detail_impacts: int = whole(100, 10_000_000)
    """Number of impacts of each orbit of the detail."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the fixed point, around which orbits rotate, is elliptic at each energy."""
        yield from super().cross_field_errors()
        yield from not_elliptic(self, "energy")
        yield from not_elliptic(self, "energies")


class Jumps(OfOrbits):
    """the curves where the map and its inverse jump"""

    stages = ("jumps", "orbits")
    headline = "jump curve"

    energies: Energies
    """Further energies, whose curves are drawn below the section."""
    sides: int = whole(4, 100_000, 4)
    """Number of straight sides of which each curve is drawn, without those that a jump of the map
    breaks. Its length with this number, half and a quarter of it gives the error of the length."""


class Flux(OfSea):
    """crossings and lobes of both branches"""

    stages = ("flux",)
    headline = "lobes"

    period: int = whole(2, 12, 2)
    """Period of the hyperbolic orbit whose branches enclose the regions."""
    distance: float = allowed("a number from 1e-5 to 1, in section radii", ge=1e-5, le=1)
    """Largest distance between neighbouring points of the traced branches."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that all impacts fit into memory."""
        yield from super().cross_field_errors()
        yield from bounded(self, "orbits", "impacts", "impacts in all")


class LastCurve(Scene):
    """residues of the convergents of noble rotation numbers"""

    stages = ("last_curve",)
    headline = "last residues"

    nobles: list[
        Annotated[
            list[Annotated[int, whole(0, 1000)]], allowed("a continued fraction", min_length=1)
        ]
    ] = allowed("a list of 1 to 8 continued fractions", default=ABSENT, min_length=1, max_length=8)
    """Noble rotation numbers, in turns per impact, each as the first quotients of its continued
    fraction: [0, 5, 1, 15] is 1/(5 + 1/(1 + 1/(15 + ...))), with ones from there on. Without this
    field one number on either side of the last curve within `between` is chosen."""
    convergents: int = whole(2, 20)
    """Number of convergents of each rotation number whose periodic orbits are found. Each has a
    period about 1.6 times as long as the one before."""
    between: Between
    """Part of the symmetry line y = 0 in which the orbits are sought, in section radii from the
    section's centre. The end nearer to the fixed point comes first."""
    drawn: int = whole(100, LARGEST)
    """Number of impacts that are drawn of the orbit from the last convergent's periodic point."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the orbits can be computed and drawn."""
        yield from super().cross_field_errors()
        yield from not_elliptic(self, "energy")
        start, end = self.between
        if start == end:
            yield ("between",), self.between, "two fractions that differ"
        nobles = self.nobles or [[1], [1]]
        for i, noble in enumerate(nobles):
            before, period = 0, 1
            for quotient in noble[1:] + [1] * (self.convergents - 1):
                before, period = period, before + quotient * period
            if not 0 < period <= LARGEST:
                words = f"one whose last convergent has a period from 1 to {LARGEST}, not {period}"
                yield ("nobles", i), noble, words
        if self.drawn * len(nobles) > LARGEST:
            words = f"at most {LARGEST} points drawn, counted over all nobles"
            yield ("drawn",), self.drawn, words


class Exclusion(Curves):
    """where no invariant circle around the fixed point can be"""

    stages = ("exclusion", "curves", "orbits")
    headline = "excluded share"

    grid: int = whole(10, 4000, 2)
    """Number of points across the section, drawn as a disk, and in the other direction. 1128 make a
    million points."""
    followed: int = whole(1, 10_000)
    """Largest number of impacts forwards and backwards by which a point is excluded."""


class Control(Scene):
    """what regular motion needs: area kept, or the reversor"""

    stages = ("control",)
    on_section = False
    headline = "regular share"

    strengths: Annotated[
        list[Annotated[float, allowed("a number from 1e-6 to 0.5", ge=1e-6, le=0.5)]],
        allowed("a rising list of 1 to 12 strengths", min_length=1, max_length=12),
        Predicate(rising),
    ]
    """Strengths eps of the changes of the map: about the largest displacement of a point, in
    section radii."""
    orbits: int = whole(10, 100_000)
    """Number of orbits of each map, which start evenly over the whole section."""
    impacts: int = whole(64, 10_000_000)
    """Number of impacts of each orbit. A spiral that changes areas by a factor of 1 - eps an impact
    is told from a curve after about 4.4/eps impacts."""
    starts: list[Fraction] = allowed("a list of 1 to 50 fractions", min_length=1, max_length=50)
    """Starts of the orbits that are drawn, as fractions of the section's radius along y = 0."""
    shown: float = allowed("one of strengths", gt=0)
    """Strength at which these orbits are drawn."""
    drawn: int = whole(1, LARGEST)
    """Number of impacts of each orbit that are drawn."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the strength shown is computed, and that all impacts fit into memory."""
        yield from super().cross_field_errors()
        if self.shown not in self.strengths:
            words = f"one of strengths: {', '.join(map(str, self.strengths))}"
            yield ("shown",), self.shown, words
        if self.drawn > self.impacts:
            yield ("drawn",), self.drawn, f"at most impacts = {self.impacts}"
        points = self.impacts * len(self.starts)
        if points > LARGEST:
            words = f"at most {LARGEST} impacts, counted over all starts"
            yield ("impacts",), self.impacts, words


class ControlShares(Picture):
    """the regular share of maps that keep area, the reversor, both or neither"""

    stages = ("control",)
    drawn_over = "control"
    on_section = False

    over: Name = allowed("the name of a scene of control")
    """Name of the scene whose shares are drawn."""
