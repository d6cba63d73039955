"""Write every generated file: pages, the schema of config.yaml, and what parts declare.

    .venv/bin/python -m pipeline.renew

They describe the parts that are there. A page that is written by hand may have one generated
section, between two comments.
"""

import sys

from .checks import figures_page
from .checks.published_sets import ChecksumError
from .config import ConfigError, json_schema, reference
from .declaration import RENEW, SCHEMA, SRC, SourceError, imported, parts
from .records.files import read_text, write_whole
from .records.sources import ROOT

BEGIN, END = f"<!-- Written by {RENEW}. -->\n", "<!-- End of what is written. -->\n"


def generated() -> dict[str, str]:
    """Map each generated file, by its path from the root, to its text."""
    texts = {
        SCHEMA: json_schema.text(),
        "docs/config.md": reference.page(),
        "docs/figures.md": figures_page.page(),
    }
    for part in parts().values():
        texts |= imported(part.committed)() if part.committed else {}
    folders = [f.parent for f in (*SRC.glob("*/part.py"), *SRC.glob("extensions/*/part.py"))]
    sections = {folder / "README.md": reference.section(folder.name) for folder in folders}
    for file, section in {ROOT / "README.md": reference.table_of_parts(), **sections}.items():
        if file.exists() or (section and file.parent != ROOT):
            text = read_text(file) if file.exists() else f"# {file.parent.name}\n"
            if section and BEGIN not in text:
                text += f"\n{BEGIN}{END}"
            texts[str(file.relative_to(ROOT))] = with_section(text, BEGIN, section, END)
    if (ROOT / "codecheck.yml").exists():
        text = read_text(ROOT / "codecheck.yml")
        manifest = figures_page.codecheck_manifest()
        texts["codecheck.yml"] = with_section(text, "\nmanifest:\n", manifest, "summary:")
    return texts


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
