"""The page docs/config.md, written from the declarations.

Run `.venv/bin/python -m pipeline.config.reference` to renew it.
"""

import inspect
from collections.abc import Iterable
from textwrap import fill, indent

from ..records.files import write_whole
from ..records.sources import ROOT
from .schema import fields
from .schema.fields import Block, fields_of
from .schema.kinds import KINDS
from .schema.scene import Scene
from .schema.stages import STAGES, upstream
from .schema.sweep import Span, Sweep
from .schema.variant import Prove, Variant
from .validation.mistakes import allowed_at

HEAD = """\
# config.yaml, field by field

This page is generated from the declarations in `src/pipeline/config/schema/` by
`.venv/bin/python -m pipeline.config.reference`. Edit it there.

`./reproduce` checks the whole file before anything runs. An unknown key, a number in quotes or a
value that is not allowed is refused with a line that names the place, the value and what is
allowed. All mistakes are reported at once.

Units: lengths are in R, the ball's radius; times in 1/omega, where omega is the frequency of its
stretching; energies in m omega^2 R^2, where m is its mass. x is the position of the mass centre,
downwards, and udot the strain rate.

The *section* is the set of states (x, y) just before an impact at one energy, with
y = xdot - k udot. Its *radius* is half its length along the symmetry line y = 0. A number in
section radii is relative to it, so that it carries over to another ball or energy."""
BALL = "The ball of every scene that has none of its own."
SCENES = """\
A scene is one figure, under the name that its block has. Names consist of letters, digits, - and _.
Every scene has these fields:"""
EXAMPLE = "A small example, under `scenes:`:"
MAPPINGS: list[tuple[str, type[Block]]] = [
    ("view", fields.View),
    ("axes: each axis", fields.Axis),
    ("branches", fields.BothBranches),
    ("branches: outer, inner", fields.Branch),
    ("resolution", fields.Resolution),
    ("window", fields.Window),
    ("starts: a point", fields.Point),
    ("method: scan and bisection", fields.Scan),
    ("method: true orbits", fields.Exact),
]
STAGES_HEAD = """\
A stage computes one dataset. Ball, energy and the fields listed here decide its data; changing
another field of the scene only draws it again."""
VARIANTS = """\
A variant is the set of the paper's scenes with some values replaced.
`./reproduce variant NAME` draws it into `results/NAME/figures/`.

Axes of the paper's scenes fit their own values. A scene whose ball, energy or extent a variant
changes takes the limits of its data, unless the variant gives `axes` for it.

The fields of a variant are:"""
SWEEPS = "A sweep classifies orbits over a grid of k and E/g^2. Its fields are:"
SPAN = "Instead of a list, `k` and `energy` may be a mapping with these fields:"
REQUEST = """\
Scenes like those under `scenes`, drawn on request by `./reproduce claims` and
`./reproduce prove --pictures`. Variants do not include them."""
PROVE = "Settings of `./reproduce prove --impacts`."


def page() -> str:
    """Return the text of the page."""
    parts = [HEAD, "## ball", BALL, _listed(fields.BallBlock)]
    parts += ["## scenes", SCENES, _listed(Scene)]
    for name, kind in KINDS.items():
        subject = (kind.__doc__ or "").partition("\n")[0]
        stages = ", ".join(f"`{stage}`" for stage in upstream(kind.stages))
        own = [
            key
            for key, field in fields_of(kind).items()
            if key not in Scene.model_fields
            or field.annotation != Scene.model_fields[key].annotation
        ]
        subject = f"{subject[0].upper()}{subject[1:]}."
        parts += [f"### picture: {name}", subject, f"Stages: {stages}."]
        parts += [_listed(kind, own), EXAMPLE]
        parts += [f"```yaml\nanother:\n{indent(example(name), '  ')}\n```"]
    parts += ["## Mappings in scenes"]
    for title, model in MAPPINGS:
        parts += [f"### {title}", _listed(model)]
    parts += ["## Stages", STAGES_HEAD, _stages(), "## variants", VARIANTS, _listed(Variant)]
    parts += ["## sweeps", SWEEPS, _listed(Sweep), SPAN, _listed(Span)]
    parts += ["## claims, proofs", REQUEST, "## prove", PROVE, _listed(Prove)]
    return "\n\n".join(parts) + "\n"


def example(name: str) -> str:
    """Return the example of a kind of picture as YAML, a block of `scenes:`."""
    return f"picture: {name}\n{inspect.cleandoc(KINDS[name].example)}"


def _listed(model: type[Block], keys: Iterable[str] = ()) -> str:
    """List fields of a model, or all of them, with their meanings and what they allow."""
    items = []
    for key in keys or fields_of(model):
        field = fields_of(model)[key]
        default = "optional" if field.default is None else f"default `{field.default}`"
        default = "required" if field.is_required() else default
        _, words = allowed_at(model, (key,))
        text = f"- `{key}` ({default}): {_meaning(model, key)} *Allowed:* {words}."
        items.append(fill(text, 100, subsequent_indent="  ", break_on_hyphens=False))
    return "\n".join(items)


def _meaning(model: type[Block], key: str) -> str:
    """Return the docstring of a field, from the nearest class that has one."""
    for base in (base for base in model.__mro__ if issubclass(base, Block)):
        field = fields_of(base).get(key)
        if field and field.description:
            return " ".join(field.description.split())
    raise ValueError(f"{model.__name__}.{key} has no docstring")


def _stages() -> str:
    lines = ["| stage | fields | made from | with `method` |", "|---|---|---|---|"]
    for name, stage in STAGES.items():
        decisive, inputs = (", ".join(f"`{x}`" for x in xs) for xs in (stage.fields, stage.inputs))
        follows = "follows it" if stage.follows else "does not depend on it"
        lines.append(f"| `{name}` | {decisive} | {inputs} | {follows} |")
    return "\n".join(lines)


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "config.md", page())
