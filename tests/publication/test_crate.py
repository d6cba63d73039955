"""The description of an archive: the same bytes everywhere, and a valid Provenance Run Crate."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from pipeline.publication import crate
from pipeline.records import swhid

SCRIPT = Path(__file__).with_name("validate_crate.py")


@pytest.fixture(scope="module")
def unpacked(packed, tmp_path_factory):
    """The folder of an archive of `accepted`."""
    folder = tmp_path_factory.mktemp("crate")
    subprocess.run(["tar", "-xf", packed], cwd=folder, check=True)
    return folder / "pseudorigid"


def test_each_result_has_an_action_with_its_inputs(unpacked):
    graph = json.loads((unpacked / crate.FILE).read_text())["@graph"]
    entities = {entity["@id"]: entity for entity in graph}
    files = {str(f.relative_to(unpacked)) for f in unpacked.rglob("*") if f.is_file()}
    described = {name for name, each in entities.items() if "File" in each["@type"]}
    assert described == files - {crate.FILE, "SHA256SUMS"}
    made = {}
    for entity in graph:
        if entity["@type"] == "CreateAction" and entity["@id"] != "#run":
            made[entity["result"]["@id"]] = entity
    assert {"results/paper/motion_fig3.nc", "paper_figures/fig3.png"} <= {*made}
    drawing = made["paper_figures/fig3.png"]
    inputs = {item["@id"] for item in drawing["object"]}
    assert "results/paper/motion_fig3.nc" in inputs
    assert drawing["instrument"]["@id"] == "#tool-draw"
    page = "https://spdx.org/licenses/BSD-3-Clause"
    assert entities["./"]["license"] == entities["Snakefile"]["license"] == {"@id": page}
    assert entities[page]["name"] == "BSD-3-Clause"
    assert all(reference["@id"] in entities for reference in references(graph))


def references(graph):
    """All references between entities, except those to pages on the web."""
    for entity in graph:
        for key, value in entity.items():
            for item in value if isinstance(value, list) else [value]:
                local = isinstance(item, dict) and "://" not in item["@id"]
                if local and key != "@id":
                    yield item


def test_the_identifier_of_a_folder_is_that_of_its_git_tree(packed, unpacked, tmp_path):
    shutil.copytree(unpacked, tmp_path / "copy")
    git = ["git", "-C", tmp_path / "copy"]
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "add", "-f", "."], check=True)
    tree = subprocess.run([*git, "write-tree"], check=True, capture_output=True, text=True)
    (tmp_path / "results" / "archive").mkdir(parents=True)
    shutil.copy(packed, tmp_path / "results" / "archive")
    assert swhid.identifiers(tmp_path) == [("a.tar", f"swh:1:dir:{tree.stdout.strip()}")]


@pytest.mark.slow
def test_the_crate_is_valid_and_mistakes_in_it_are_not(unpacked, tmp_path, environment_of):
    python = environment_of("crate")

    def issues(folder):
        command = [python, SCRIPT, folder, "REQUIRED"]
        result = subprocess.run(command, check=False, capture_output=True, text=True)
        assert " issues" in result.stdout, result.stderr
        return result.stdout.splitlines()[:-1]

    assert issues(unpacked) == []
    copy = tmp_path / "copy"
    shutil.copytree(unpacked, copy)
    text = (copy / crate.FILE).read_text()
    (copy / crate.FILE).write_text(text.replace('"workExample"', '"example"'))
    assert any("workExample" in line for line in issues(copy))
