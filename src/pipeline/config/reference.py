"""docs/config.md, from the declarations: `.venv/bin/python -m pipeline.config.reference`."""

import ast
import inspect
from itertools import pairwise
from textwrap import indent

from ..records.files import write_whole
from ..records.sources import ROOT
from .schema.fields import Axis, BallBlock, Block, Scan
from .schema.kinds import KINDS
from .schema.scene import Scene
from .schema.stages import STAGES, upstream
from .schema.sweep import SPAN_MEANINGS, Span, Sweep
from .schema.variant import Prove, Variant
from .validation.mistakes import allowed_at

HEAD = """\
# config.yaml, field by field

Made from the declarations in `src/pipeline/config/schema/` by
`.venv/bin/python -m pipeline.config.reference`. Lengths are in R and times in 1/omega; what is said
to be in section radii is relative to the radius of the section along the symmetry line
y = xdot - k udot = 0. A block with an unknown key, a number in quotes or a value out of bounds is
refused before anything runs, all mistakes at once."""
EXACT = """\
Or `{exact: true}`: the orbits of the starts as they are written, in portraits and
backdrops, every number a rounded true value."""
REQUEST = "Scenes that are made on request: `./reproduce claims`, `./reproduce prove --pictures`."
EXAMPLE = "Another small one, under `scenes:`, for example:"
SPAN = "Instead of a list, `k` and `energy` may be a mapping with these fields:"
AXES = "limits and ticks of each axis; without them those of the data"


def page() -> str:
    """The whole page."""
    parts = [HEAD, "## ball", "The ball of every scene without one of its own."]
    parts += [_table(BallBlock, BallBlock.model_fields), "## scenes"]
    parts += ["A scene is one figure. Every scene has these fields:"]
    parts += [_table(Scene, Scene.model_fields)]
    for name, kind in KINDS.items():
        of_all = {field: info.annotation for field, info in Scene.model_fields.items()}
        own = [field for field in kind.model_fields if field not in of_all]
        narrowed = [f for f in of_all if kind.model_fields[f].annotation != of_all[f]]
        first = kind.__doc__.partition("\n")[0]
        drawn = ", ".join(f"`{stage}`" for stage in upstream(kind.stages))
        about = f"{first[0].upper()}{first[1:]}. Computed: {drawn}."
        parts += [f"### picture: {name}", about, _table(kind, [*own, *narrowed])]
        parts += [f"{EXAMPLE}\n\n```yaml\nanother:\n{indent(example(name), '  ')}\n```"]
    parts += ["## An axis", _table(Axis, Axis.model_fields)]
    parts += ["## A method", "The paper's own, by steps and bisection:"]
    parts += [_table(Scan, Scan.model_fields), EXACT]
    parts += ["## Stages", "What decides the data of a stage, beside ball and energy:", _stages()]
    parts += ["## variants", "A variant replaces values of the paper's scenes:"]
    parts += [_table(Variant, Variant.model_fields)]
    parts += ["## sweeps", "A sweep is a grid over k and E/g^2:"]
    parts += [_table(Sweep, Sweep.model_fields), SPAN]
    parts += [_table(Span, Span.model_fields), "## claims, proofs", REQUEST]
    parts += ["## prove", "`./reproduce prove --impacts`:", _table(Prove, Prove.model_fields)]
    return "\n\n".join(parts) + "\n"


def example(name) -> str:
    """The example of a kind of picture as YAML, a block of `scenes:`."""
    return f"picture: {name}\n{inspect.cleandoc(KINDS[name].example)}"


def _table(model, names) -> str:
    lines = ["| field | meaning | allowed | default |", "|---|---|---|---|"]
    return "\n".join([*lines, *_rows(model, names)])


def _stages() -> str:
    lines = ["| stage | fields | made from | with `method` |", "|---|---|---|---|"]
    for name, stage in STAGES.items():
        fields, inputs = (", ".join(f"`{x}`" for x in xs) for xs in (stage.fields, stage.inputs))
        follows = "follows it" if stage.follows else "does not depend on it"
        lines.append(f"| `{name}` | {fields} | {inputs} | {follows} |")
    return "\n".join(lines)


def _rows(model, names, place=""):
    """A line for each field, and below it those of the mapping that it is."""
    meanings = {"axes": AXES} | (SPAN_MEANINGS if model is Span else _meanings(model))
    for name in names:
        field = model.model_fields[name]
        default = "" if field.default is None else f"`{field.default}`"
        default = "required" if field.is_required() else default
        kind, allowed = allowed_at(model, (name,))
        allowed = " ".join(allowed.split()).replace("|", "\\|")
        yield f"| `{place}{name}` | {meanings[name]} | {allowed} | {default} |"
        if isinstance(kind, type) and issubclass(kind, Block) and name not in ("ball", "axes"):
            yield from _rows(kind, kind.model_fields, f"{place}{name}.")


def _meanings(model):
    """Field -> the text below it, in its class or in one that this derives from."""
    found = {}
    for part in reversed(model.__mro__):
        if issubclass(part, Block):
            (declared,) = ast.parse(inspect.getsource(part)).body
            for field, text in pairwise(declared.body):
                if isinstance(field, ast.AnnAssign) and isinstance(text, ast.Expr):
                    found[field.target.id] = " ".join(text.value.value.split())
    return found


if __name__ == "__main__":
    write_whole(ROOT / "docs" / "config.md", page())
