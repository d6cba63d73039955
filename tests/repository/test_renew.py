"""pipeline.renew writes every generated file, and these have what the parts that are there have."""

import re
import shutil
from functools import cache

import pytest
from project import ROOT, check_jsonschema, fresh_tree, shipped, small
from test_documents import HEADLINES, links

from pipeline import renew
from pipeline.config import reference
from pipeline.declaration import RENEW, SCHEMA, parts, stale_pages

# The study, and the parts that need it: name -> folder.
GONE = {name: f"src/extensions/{name}" for name in ("atlas", "claims", "families")}
GONE["study"] = "src/study"


page, section = cache(reference.page), cache(reference.section)


@pytest.fixture(scope="module")
def generated():
    """File -> text, of this tree."""
    if fault := stale_pages():
        pytest.skip(fault)
    return renew.generated()


def test_the_generated_files_are_current(generated):
    for name, text in generated.items():
        assert (ROOT / name).read_text(encoding="utf-8") == text, f"{name}: run {RENEW}"


def test_only_the_marked_section_of_a_page_is_written():
    page = "# A\nwords\n<!-- a -->\nold\n<!-- b -->\nmore\n"
    changed = renew.with_section(page, "<!-- a -->\n", "new\n", "<!-- b -->\n")
    assert changed == page.replace("old", "new")
    assert renew.with_section("# A\n", "<!-- a -->\n", "new\n", "<!-- b -->\n") == "# A\n"


def whole_tree(path):
    """A fresh tree with all documents and published pictures."""
    document = small(shipped())
    tree = fresh_tree(path, {key: document[key] for key in ("ball", "scenes")})
    for name in ("README.md", "CONTRIBUTING.md", "codecheck.yml", SCHEMA):
        shutil.copy(ROOT / name, path)
    for name in ("docs", "paper_figures", "more_figures"):
        shutil.copytree(ROOT / name, path / name, dirs_exist_ok=True)
    return tree


def names_of(part):
    """The names of what a part declares, as they stand in generated files."""
    declared = parts()[part]
    found = {part, *declared.stages, *declared.sets, *reference.kinds_of(part)}
    return found | {each.key for each in declared.sets.values()} | declared.commands.keys()


@pytest.mark.slow
def test_a_deleted_part_leaves_no_trace(tmp_path):
    if stale_pages() or not {*GONE, "explorer"} <= parts().keys():
        pytest.skip("it starts from all parts")
    tree = whole_tree(tmp_path / "tree")
    for name, folder in GONE.items():
        shutil.rmtree(tree.path / folder)
        shutil.rmtree(tree.path / "more_figures" / name)
    gone = f"generated files describe parts that are not there ({', '.join(sorted(GONE))})"
    assert tree.run("-n").stdout.endswith(f"\nreproduce: {gone}: run {RENEW}\n")
    result = tree.python("-m", "pipeline.renew")
    assert result.returncode == 0, result.stderr
    assert "docs/config.md: renewed\n" in result.stdout
    assert "reproduce: " not in tree.run("-n").stdout
    fields = {"energy", ""}  # also the name of a field of scenes; no key
    names = "|".join(set().union(*map(names_of, GONE)) - fields)
    trace = re.compile(rf'(?<=[`"/ ])({names})(?=[`"/]|: run)')
    written = [SCHEMA, "codecheck.yml", "docs/config.md", "docs/figures.md"]
    texts = {name: (tree.path / name).read_text() for name in written}
    readme = (tree.path / "README.md").read_text()
    texts["README.md"] = readme.partition(renew.BEGIN)[2].partition(renew.END)[0]
    assert {name: found for name, text in texts.items() if (found := trace.findall(text))} == {}
    patterns = ("*.md", "docs/**/*.md", "src/**/*.md")
    for page in (page for pattern in patterns for page in tree.path.glob(pattern)):
        for link in links(page.read_text()):
            known = (page.name, link) in HEADLINES and page.parent == tree.path
            assert known or (page.parent / link).exists(), (page, link)
    explorer = (tree.path / "src/extensions/explorer/explorer.html").read_text()
    assert '"atlas":null' in explorer and "rotation:()=>" not in explorer.replace(" ", "")
    status, said = check_jsonschema("--schemafile", tree.path / SCHEMA, tree.config)
    assert status == 0, said
    assert tree.python("-m", "pipeline.renew").stdout == "every generated file is current\n"
    shutil.copytree(ROOT / "src/study", tree.path / "src/study")
    new = f"reproduce: generated files lack parts that are there (study): run {RENEW}\n"
    assert tree.run("-n").stdout.endswith(new)
