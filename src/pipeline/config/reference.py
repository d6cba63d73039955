"""docs/config.md, from the declarations: `.venv/bin/python -m pipeline.config.reference`."""

from ..records.files import replacing
from ..records.sources import ROOT
from .checking.mistakes import allowed_at
from .declared.fields import BallBlock
from .declared.kinds import KINDS
from .declared.scene import Scene
from .declared.stages import STAGES, behind
from .declared.sweep import Sweep
from .declared.variant import Variant

HEAD = """\
# config.yaml, field by field

Made from the declarations in `src/pipeline/config/declared/` by
`.venv/bin/python -m pipeline.config.reference`. Lengths are in R and times in 1/omega; what is said
to be in section radii is relative to the radius of the section along the symmetry line
y = xdot - k udot = 0. A block with an unknown key, a number in quotes or a value out of bounds is
refused before anything runs, all mistakes at once.

## ball

The ball of every scene without one of its own.

"""


def page() -> str:
    """The whole page."""
    parts = [HEAD, _table(BallBlock, BallBlock.model_fields), "\n## scenes\n"]
    parts.append("\nA scene is one figure. Every scene has these fields:\n\n")
    parts.append(_table(Scene, Scene.model_fields))
    for name, kind in KINDS.items():
        own = [field for field in kind.model_fields if field not in Scene.model_fields]
        narrowed = [
            field
            for field in Scene.model_fields
            if kind.model_fields[field].annotation != Scene.model_fields[field].annotation
        ]
        drawn = ", ".join(f"`{stage}`" for stage in behind(kind.stages))
        parts.append(f"\n### picture: {name}\n\n{_sentence(kind.__doc__)} Computed: {drawn}.\n\n")
        parts.append(_table(kind, [*own, *narrowed]))
    parts.append("\n## Stages\n\nWhat decides the data of a stage, beside ball and energy:\n\n")
    parts.append("| stage | fields | made from | with `method` |\n|---|---|---|---|\n")
    for name, stage in STAGES.items():
        fields, inputs = (", ".join(f"`{x}`" for x in xs) for xs in (stage.fields, stage.inputs))
        follows = "follows it" if stage.follows else "does not depend on it"
        parts.append(f"| `{name}` | {fields} | {inputs} | {follows} |\n")
    parts.append("\n## variants\n\nA variant replaces values of the paper's scenes:\n\n")
    parts.append(_table(Variant, Variant.model_fields))
    parts.append("\n## sweeps\n\nA sweep is a grid over k and E/g^2:\n\n")
    parts.append(_table(Sweep, Sweep.model_fields))
    return "".join(parts)


def _table(model, names) -> str:
    lines = ["| field | allowed | default |", "|---|---|---|"]
    for name in names:
        field = model.model_fields[name]
        default = (
            "required"
            if field.is_required()
            else ""
            if field.default is None
            else (f"`{field.default}`")
        )
        lines.append(f"| `{name}` | {_cell(allowed_at(model, (name,)))} | {default} |")
    return "\n".join(lines) + "\n"


def _cell(text) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _sentence(text) -> str:
    first = text.partition("\n")[0]
    return f"{first[0].upper()}{first[1:]}."


if __name__ == "__main__":
    with replacing(ROOT / "docs" / "config.md") as part:
        part.write_text(page(), encoding="utf-8")
