"""Pictures, scenes, their methods, and variants of config.yaml.

A kind of picture is one class in `kinds`, derived from these. Checks that need more than one field
stand with the group. They compare numbers as the decimals that were written.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Self

from annotated_types import Predicate
from pydantic import ConfigDict, Discriminator

from pseudorigid.dynamics.bounds import energy_mistake, g_mistake

from . import fields
from .fields import ABSENT, allowed
from .parts import METHODS

CrossFieldError = tuple[tuple[str | int, ...], Any, str]  # place in the scene, value, what to give


class CompletionError(Exception):
    """A shorthand that cannot be written out; the arguments are those of a CrossFieldError."""


class Scan(fields.Block):
    """A search for the next impact in equal steps of time."""

    scan: float = allowed("the scan's step, a number from 0.001 to 1", ge=0.001, le=1)
    """Time step, in 1/omega, at which the sign of the gap between ball and floor is inspected, for
    instance 0.1. A smaller one misses fewer impacts; a ball whose impact is missed falls through
    the floor."""
    tolerance: float = allowed("a number from 1e-15 to 0.001", ge=1e-15, le=0.001)
    """Width in time, in 1/omega, at which bisection ends. 1.0e-12 leaves little but rounding, and
    scenes with manifolds allow no more."""


def _tag(value: Any) -> str:
    """Return the tag of the method whose block or mapping a value is meant to be."""
    keys = value if isinstance(value, Mapping) else getattr(value, "model_fields_set", ())
    return fields.TAGS[not METHODS.keys().isdisjoint(keys)]


_WORDS = [fields.mapping_with([*Scan.model_fields]), *map("{{{}: true}}".format, METHODS)]
_EITHER: Any = Scan
if METHODS:
    (_block,) = METHODS.values()  # the second of two tags
    _TAGGED: Any = Annotated[Scan, fields.FIRST] | Annotated[_block, fields.SECOND]
    _EITHER = Annotated[_TAGGED, Discriminator(_tag)]
Method: Any = Annotated[_EITHER, allowed(", or ".join(_WORDS))]


class Picture(fields.Block):
    """The fields that scenes of every kind have."""

    model_config = ConfigDict(json_schema_extra={})  # the description is that of the kind

    # Stages that compute the data, in the order in which the kind's `draw` takes their datasets.
    stages: ClassVar[tuple[str, ...]]
    # Function draw(block, *datasets), by default `draw` in the module of the kind's name.
    drawn_by: ClassVar[str] = ""
    # Function (block, **datasets) -> quantity -> value as text, in the module `reports` beside it.
    reported_by: ClassVar[str] = ""
    # Fields that decide nothing that is drawn.
    undrawn: ClassVar[tuple[str, ...]] = ("formats",)
    # A variant that changes one of these, the ball or the energy inherits no `axes`.
    axes_depend_on: ClassVar[tuple[str, ...]] = ()
    # The quantity among those that the picture reports that stands for it in a list.
    headline: ClassVar[str] = ""
    # The kind of the scene that a field `over` names; its fields and its data are this scene's too.
    drawn_over: ClassVar[str] = ""
    # Keys that scenes had once -> what to say of them.
    removed: ClassVar[Mapping[str, str]] = {}
    # Whether it shows orbits on one section of the paper's map, as the section at an energy.
    on_section: ClassVar[bool] = False

    picture: str = allowed("the kind of picture: one of those below")
    """What the figure shows."""
    formats: fields.Formats = ["png"]
    """File formats of the figure. png and svg are published; pdf stays in `results/`."""

    def completed(self) -> Self:
        """Return the scene with shorthands written out; raises CompletionError."""
        return self

    def given_axes(self) -> Mapping[str, fields.Axis]:
        """Return the axes of the scene that the config has."""
        return getattr(self, "axes", None) or {}

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Yield what is wrong between fields, each of which has its type."""
        for name, axis in self.given_axes().items():
            low, high = axis.limits
            for tick in axis.ticks:
                if low < high and not low <= tick <= high:
                    words = f"numbers within the limits {axis.limits}"
                    yield ("axes", name, "ticks"), tick, words


class Scene(Picture):
    """The fields that scenes of a ball and an energy have."""

    on_section = True

    ball: fields.BallBlock = ABSENT
    """The ball of this scene, by default that at the top of the file."""
    energy: fields.Energy
    """Total energy of the ball, in m omega^2 R^2; every impact keeps it. Below the lower bound
    there is no motion, above the upper one the ball could flatten to nothing, eq. (31)."""
    method: Method = ABSENT
    """How the next impact is found. Leave it out unless you want to compare methods: the first
    impact is then found with a certificate that none was missed."""

    def along_energy(self) -> bool:
        """Return whether the scene follows something over energies, from end to end of `span`."""
        return getattr(self, "parameter", None) == "energy"

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check the ball, its energies, and ticks."""
        k, g = self.ball.k, self.ball.g
        if words := g_mistake(k, g):
            yield ("ball", "g"), g, words
            return
        names = ["energy", "energies"] + ["span"] * self.along_energy()
        for place, energy in entries(self, *names):
            if words := energy_mistake(k, g, energy):
                yield place, energy, words
        yield from super().cross_field_errors()


_PATH = re.compile(r"ball\.[kg]|energy|scenes\.[^.]+\..+")
_ONE_PATH = "a mapping from one of ball.k, ball.g, energy and scenes.NAME.FIELD to its values"
_VALUES = allowed("a list of numbers or texts, none of them twice", min_length=1)
_Value = Annotated[
    Annotated[str, fields.FIRST] | Annotated[fields.Number, fields.SECOND],
    fields.first_if(str),
    allowed("a number or a text"),
]


class Variant(fields.Block):
    """The paper's scenes with some values replaced, or a range of such variants."""

    ball: fields.PartOfBall = ABSENT
    """Replaces `k`, `g` or both in the ball of every scene."""
    energy: fields.Energy = ABSENT
    """Replaces the energy of every scene."""
    method: Method = ABSENT
    """Replaces the method of every scene."""
    scale: float = allowed(
        "a number from 1e-6 to 1e6, by which every length is multiplied",
        default=ABSENT,
        ge=1e-6,
        le=1e6,
    )
    """Changes the unit of length. g, positions and velocities are multiplied by this number, and
    energies by its square; times and exponents stay."""
    scenes: Annotated[
        dict[str, Annotated[fields.YamlMapping, allowed("a mapping with fields of the scene")]],
        allowed("a mapping from names of scenes to the fields that differ"),
    ] = ABSENT
    """Replaces fields of single scenes, after the fields above. Mappings are merged key by key;
    lists, numbers and texts are replaced."""
    values: Annotated[
        dict[str, Annotated[list[_Value], _VALUES, Predicate(fields.distinct)]],
        allowed(_ONE_PATH, min_length=1, max_length=1),
        Predicate(lambda given: all(map(_PATH.fullmatch, given))),
    ] = ABSENT
    """Makes a range: a variant for each of these values, with all other fields as here."""


VARIANTS = Annotated[
    dict[fields.Name, Annotated[Variant, fields.NOT_EMPTY]],
    allowed("a mapping from names to variants"),
]


def entries(scene: Picture, *names: str) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Yield place and value of those fields that the scene has, and of each entry of a list."""
    for name in names:
        value = getattr(scene, name, [])
        if isinstance(value, list):
            yield from (((name, i), entry) for i, entry in enumerate(value))
        else:
            yield (name,), value
