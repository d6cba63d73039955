"""Links, files, commands and examples in README and docs exist and work."""

import re
from fnmatch import fnmatch

import pytest
import yaml
from project import ROOT

from pipeline import config, declaration
from pipeline.config import reference
from pipeline.declaration import parts

DOCUMENTS = sorted(
    str(file.relative_to(ROOT)) for file in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
)
# Folders of the repository; results and .venv are left out.
FOLDERS = (".github", "src", "tests", "config", "docs", "workflow", "profiles", "requirements")
FOLDERS += ("paper_figures", "more_figures")
FILES = [
    str(file.relative_to(ROOT))
    for files in (ROOT.glob("*"), *((ROOT / folder).rglob("*") for folder in FOLDERS))
    for file in files
    if file.is_file()
]
SUFFIX = r"\.(?:py|md|yaml|yml|toml|json|txt|png|svg|cff|nc|smk|tar)"


# Files that a module writes: python -m MODULE renews them.
GENERATED = {"docs/config.md": reference}


def is_absent(name):
    """Whether a file is one of an extension that is not there, or of any if there is none."""
    found = re.search(r"\bextensions/(\w+)/", name)
    if found:
        return found[1] not in parts()
    return not parts() and name in declaration.__doc__


def text_of(document):
    return (ROOT / document).read_text(encoding="utf-8")


def blocks(document):
    """The indented blocks of a document, without the indent."""
    found = re.findall(r"(?:^|\n)\n((?:    .*\n|\n(?=    ))+)", text_of(document))
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip("\n") for block in found]


@pytest.mark.skipif(not parts(), reason="the committed pages are those with extensions")
@pytest.mark.parametrize(("file", "module"), GENERATED.items())
def test_a_generated_file_is_up_to_date(file, module):
    assert text_of(file) == module.page(), f"renew it: python -m {module.__name__}"


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_to_files(document):
    folder = (ROOT / document).parent
    for link in re.findall(r"\]\(([^)\s]+)\)", text_of(document)):
        if not link.startswith(("http:", "https:")) and not is_absent(link):
            assert (folder / link.partition("#")[0]).exists(), link


@pytest.mark.parametrize("document", [name for name in DOCUMENTS if name != "CHANGELOG.md"])
def test_named_files_exist(document):
    """Paths, and names in backquotes, are those of a file or the end of its path."""
    text = re.sub(r"https?://\S+", "", text_of(document))
    words = re.findall(rf"[\w./*-]*/[\w./*-]*{SUFFIX}\b", text)
    words += re.findall(rf"`([\w-]+{SUFFIX})`", text)
    for word in words:
        name = word.removeprefix("../")
        made = name.startswith("results/") or name.endswith(".nc") or "NAME" in name
        if not made and not is_absent(name):
            assert any(fnmatch(f"/{file}", f"*/{name}") for file in FILES), word


def test_the_variant_of_the_readme():
    (block,) = (text for text in blocks("README.md") if text.startswith("variants:"))
    document = yaml.safe_load(text_of("config.yaml")) | yaml.safe_load(block)
    variant = config.check(document).variants["lower-energy"]
    assert variant["fig3"].duration == 30 and variant["fig2"].energy == 0.0098
