"""Write every generated file: pages, the schema of config.yaml, and what parts add.

    .venv/bin/python -m pipeline.renew

The fields of all parts' scenes are a section between two comments.
"""

import sys
from pathlib import Path

import jinja2

from .config import MAIN, ConfigError, reference
from .config.schema.kinds import KINDS
from .declaration import RENEW, Stage, imported, parts
from .records.files import read_text, write_whole
from .records.sources import ROOT

BEGIN, END = f"<!-- Written by {RENEW}. -->\n", "<!-- End of what is written. -->\n"


def generated() -> dict[str, str]:
    """Map each generated file, by its path from the root, to its text."""
    texts = {"config.schema.json": reference.json_schema(), f"workflow/rules/{MAIN}.smk": rules()}
    texts["docs/config.md"] = with_section(
        read_text(ROOT / "docs/config.md"), BEGIN, reference.fields(), END
    )
    for declared in parts().values():
        texts |= imported(declared.committed)() if declared.committed else {}
    return texts


def rules() -> str:
    """Return the text of the rules for the part that has the main set of scenes."""
    name, part = next((name, part) for name, part in parts().items() if MAIN in part.sets)
    found = [
        stage._asdict() | {"name": n, "stages": stage.inputs, "file": f"{n}_{{scene}}.nc"}
        for n, stage in part.stages.items()
    ]
    for kind, of in KINDS.items():
        if of.__module__ == f"{name}.kinds":
            of_kind = {"name": f"draw_{kind}", "stages": of.stages, "kind": kind}
            found.append(Stage(of.drawn_by)._asdict() | of_kind | {"file": "{scene}.{extension}"})
    text = Path(__file__).with_name("rules.smk.jinja").read_text(encoding="utf-8")
    environment = jinja2.Environment(trim_blocks=True, keep_trailing_newline=True)
    return environment.from_string(text).render(rules=found)


def with_section(text: str, begin: str, section: str, end: str) -> str:
    """Replace what stands between two marks in a text; without the marks it stays as it is."""
    before, mark, rest = text.partition(begin)
    _, mark_of_end, after = rest.partition(end)
    return f"{before}{mark}{section}{end}{after}" if mark and mark_of_end else text


def main() -> int:
    """Write the generated files that are not current, name them, and return the exit status."""
    try:
        texts = generated()
        outdated = [n for n in texts if not (ROOT / n).exists() or read_text(ROOT / n) != texts[n]]
        for name in outdated:
            write_whole(ROOT / name, texts[name])
            print(f"{name}: renewed")
    except (ConfigError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    if not outdated:
        print("every generated file is current")
    return 0


if __name__ == "__main__":
    sys.exit(main())
