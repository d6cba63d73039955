"""Links, files, commands and examples in README and docs exist and work."""

import re
from fnmatch import fnmatch

import pytest
import yaml

from helpers.pages import blocks, text_of
from helpers.project import ROOT
from pipeline import config, declaration
from pipeline.cli import arguments
from pipeline.command_list import COMMANDS, all_commands

PATTERNS = "*.md", "docs/**/*.md", "src/**/README.md", "src/extensions/*/*/*.md", "tests/README.md"
DOCUMENTS = sorted({str(file.relative_to(ROOT)) for each in PATTERNS for file in ROOT.glob(each)})
# Folders of the repository; results and .venv are left out.
FOLDERS = (".github", "src", "tests", "docs", "workflow", "profiles", "requirements")
FOLDERS += ("paper_figures", "more_figures")
PATHS = [*ROOT.glob("*"), *(path for folder in FOLDERS for path in (ROOT / folder).rglob("*"))]
FILES = [str(path.relative_to(ROOT)) for path in PATHS if path.is_file()]
QUOTES = '"' * 3
SUFFIX = r"\.(?:py|md|yaml|yml|toml|json|txt|png|svg|cff|nc|smk|tar)"


def anchors(text):
    """The places of a document, as GitHub names its headings."""
    titles = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w -]", "", title).strip().lower().replace(" ", "-") for title in titles}


def is_absent(name):
    """Whether a file is one of a part that is not there, or of its tests."""
    tests = re.match(r"(?:tests/)?(extensions|study|helpers/parts)/", name)
    if tests and not (ROOT / "tests" / tests[1]).is_dir():
        return True
    found = re.search(r"\b(?:extensions/|src/)(?!extensions/)(\w+)/", name)
    return bool(found) and not [*ROOT.glob(f"src/{found[1]}"), *ROOT.glob(f"src/*/{found[1]}")]


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_to_files(document):
    for link in re.findall(r"\]\((?!https?:)([^)\s]+)\)", text_of(document)):
        path, _, place = link.partition("#")
        file = (ROOT / document).parent / path if path else ROOT / document
        assert file.exists() or is_absent(path), link
        if place and file.exists():
            assert place in anchors(file.read_text(encoding="utf-8")), link


def test_the_page_of_tests_has_the_modules_that_tests_share():
    shared = ROOT / "tests" / "helpers"
    for file in {*shared.rglob("*.py")} - {*shared.rglob("__init__.py")}:
        name, first = file.relative_to(shared).with_suffix(""), file.read_text().splitlines()[0]
        assert f"| `{name}` | {first.replace(QUOTES, '')} |\n" in text_of("tests/README.md")


def test_the_page_of_commands_has_those_of_parts():
    rows = re.findall(r"\| `\./reproduce (\w+)` \| (.*) \|\n", text_of("docs/commands.md"))
    for name in all_commands().keys() - COMMANDS.keys():
        assert (name, all_commands()[name].line) in rows, "add a row to docs/commands.md"


@pytest.mark.skipif(len(declaration.parts()) < 9, reason="it starts from all parts")
@pytest.mark.parametrize("document", [n for n in DOCUMENTS if n != "CHANGELOG.md"])
def test_arguments_of_commands_are_known(document):
    other = "help|.*--(?:help|version|offline)"  # what ends with a help, or is read by sh
    pattern = rf"(?:^    |`)\./reproduce( (?!{other})[^`#&\n]*)"
    for words in re.findall(pattern, text_of(document), re.M):
        arguments.read(words.split())


@pytest.mark.parametrize("document", [n for n in DOCUMENTS if n != "CHANGELOG.md"])
def test_named_files_exist(document):
    """Paths, and names in backquotes, are those of a file or the end of its path."""
    text = re.sub(r"https?://\S+|git show \S+", "", text_of(document))
    words = re.findall(rf"[\w./*-]*/[\w./*-]*{SUFFIX}\b", text)
    words += re.findall(rf"`([\w-]+{SUFFIX})`", text)
    for word in words:
        name = re.sub(r"^(?:\.\./)+", "", word)
        made = name.startswith("results/") or name.endswith(".nc") or "NAME" in name
        made |= name in declaration.__doc__  # the names of files that any part may have
        if not made and not is_absent(name):
            assert any(fnmatch(f"/{file}", f"*/{name}") for file in FILES), word


def test_the_variants_of_the_page_of_commands():
    (block,) = (text for text in blocks("docs/commands.md") if text.startswith("variants:"))
    document = yaml.safe_load(text_of("config.yaml")) | yaml.safe_load(block)
    variants = config.check(document).variants
    variant = variants["lower-energy"]
    assert variant["fig3"].duration == 30 and variant["fig2"].energy == 0.0098
    assert variants["gravity-0p03"]["fig2"].ball.g == 0.03
