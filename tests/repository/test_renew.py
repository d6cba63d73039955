"""pipeline.renew writes every generated file, also where parts were deleted."""

import re
import shutil

import pytest

from helpers.project import ROOT, check_jsonschema, fresh_tree, shipped, small
from pipeline import renew
from pipeline.config import reference
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.scene import Scene
from pipeline.declaration import RENEW, parts

# The study, and the parts that need it: name -> folder.
GONE = {name: f"src/extensions/{name}" for name in ("atlas", "claims", "families")}
GONE["study"] = "src/study"


def test_the_generated_files_are_current():
    for name, text in renew.generated().items():
        assert (ROOT / name).read_text(encoding="utf-8") == text, f"{name}: run {RENEW}"


def test_every_field_is_explained_once():
    text = reference.fields()
    assert not re.search(r"^ *- `\w+`( \(.*?\))?: \*Allowed:\*", text, re.M)
    items = [re.sub(r"\(.*?\)", "", each, count=1) for each in text.split("- `")]
    long = [" ".join(item.split()) for item in items if len(item.split()) > 12]
    least = 60 if (ROOT / "src" / "extensions").is_dir() else 40  # parts have fields of their own
    assert len(long) > least and len(set(long)) == len(long)


def test_a_kind_names_the_common_fields_that_it_lacks():
    sections = reference.fields().split("\n### picture: ")[1:]
    for name, _, section in (each.partition("\n") for each in sections):
        without = re.search(r"; without (.*)\.\n", section)
        named = re.findall(r"`(\w+)`", without[1]) if without else []
        assert {*named} == {*Scene.model_fields} - {*KINDS[name].model_fields}, name


def test_only_the_marked_section_of_a_page_is_written():
    page = "# A\nwords\n<!-- a -->\nold\n<!-- b -->\nmore\n"
    changed = renew.with_section(page, "<!-- a -->\n", "new\n", "<!-- b -->\n")
    assert changed == page.replace("old", "new")
    assert renew.with_section("# A\n", "<!-- a -->\n", "new\n", "<!-- b -->\n") == "# A\n"


@pytest.mark.slow
def test_parts_can_be_deleted(tmp_path):
    if not {*GONE, "explorer"} <= parts().keys():
        pytest.skip("it starts from all parts")
    document = small(shipped())
    tree = fresh_tree(tmp_path / "tree", {key: document[key] for key in ("ball", "scenes")})
    for name in ("docs", "paper_figures", "more_figures"):
        shutil.copytree(ROOT / name, tree.path / name, dirs_exist_ok=True)
    for name, folder in GONE.items():
        shutil.rmtree(tree.path / folder)
        shutil.rmtree(tree.path / "more_figures" / name)
    tree.succeed("-n")
    result = tree.python("-m", "pipeline.renew")
    assert result.returncode == 0, result.stderr
    assert "docs/figures.md: renewed\n" in result.stdout
    assert tree.python("-m", "pipeline.renew").stdout == "every generated file is current\n"
    explorer = (tree.path / "src/extensions/explorer/explorer.html").read_text()
    assert '"atlas":null' in explorer and "rotation:()=>" not in explorer.replace(" ", "")
    status, said = check_jsonschema("--schemafile", tree.path / "config.schema.json", tree.config)
    assert status == 0, said
