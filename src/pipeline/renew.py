"""Write every generated file: pages, the schema of config.yaml, and what parts add.

    .venv/bin/python -m pipeline.renew

The fields of all parts' scenes, and README's figures, are sections between two comments.
"""

import sys
from pathlib import Path

import jinja2

from .checks import figures_page
from .checks.published_sets import ChecksumError
from .config import MAIN, ConfigError, reference
from .config.schema.kinds import KINDS
from .declaration import RENEW, SourceError, imported, parts
from .records.files import read_text, write_whole
from .records.sources import ROOT

FIGURES = f"<!-- The figures, written by {RENEW}. -->\n"
BEGIN, END = f"<!-- Written by {RENEW}. -->\n", "<!-- End of what is written. -->\n"


def generated() -> dict[str, str]:
    """Map each generated file, by its path from the root, to its text."""
    texts = {"config.schema.json": reference.json_schema(), "docs/figures.md": figures_page.page()}
    texts[f"workflow/rules/{MAIN}.smk"] = rules()
    for declared in parts().values():
        texts |= imported(declared.committed)() if declared.committed else {}
    fields = "".join(map(reference.fields, parts()))
    for name, begin, section in (
        ("docs/config.md", BEGIN, fields),
        ("README.md", FIGURES, figures_page.main_figures()),
    ):
        if (ROOT / name).exists():
            texts[name] = with_section(read_text(ROOT / name), begin, section, END)
    if (ROOT / "codecheck.yml").exists():
        text = read_text(ROOT / "codecheck.yml")
        manifest = figures_page.codecheck_manifest()
        texts["codecheck.yml"] = with_section(text, "\nmanifest:\n", manifest, "summary:")
    return texts


def rules() -> str:
    """Return the text of the rules for the part that has the main set of scenes."""
    name, part = next((name, part) for name, part in parts().items() if MAIN in part.sets)
    found = [
        {"name": n, "function": stage.function, "stages": stage.inputs, "file": f"{n}_{{scene}}.nc"}
        for n, stage in part.stages.items()
    ]
    for kind, of in KINDS.items():
        if of.__module__ == f"{name}.kinds":
            of_kind = {"name": f"draw_{kind}", "function": of.drawn_by, "stages": of.stages}
            found.append(of_kind | {"file": "{scene}.{extension}", "kind": kind})
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
            (ROOT / name).parent.mkdir(exist_ok=True)
            write_whole(ROOT / name, texts[name])
            print(f"{name}: renewed")
    except (ConfigError, ChecksumError, SourceError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    if not outdated:
        print("every generated file is current")
    return 0


if __name__ == "__main__":
    sys.exit(main())
