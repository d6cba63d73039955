"""verify names each planted fault in its layer."""

import json
import re
import shutil
import time
from importlib import import_module, metadata
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from PIL import Image

from helpers.project import ROOT, SHIPPED
from helpers.verdicts import commit, verified
from pipeline import config
from pipeline.checks import manifest
from pipeline.checks.published_sets import committed_sets, edited_lists
from pipeline.checks.verify import Findings
from pipeline.cli import arguments
from pipeline.cli.table import WHAT_TO_DO
from pipeline.config.schema.parts import SETS
from pipeline.records import pictures
from pipeline.records.provenance import read_record, record_path
from pipeline.records.sources import syntax_hash
from pseudorigid.figures.canvas.render import png

FIGURE, SVG = "paper_figures/fig3.png", "paper_figures/fig7.svg"
DRAWING = "results/paper/figures/fig3.png"
PERIODIC, ORBITS = "results/paper/periodic_fig3.nc", "results/paper/orbits_fig2.nc"
MOTION = "results/paper/motion_fig4.nc"  # has the longest arrays


def unwrapped(text):
    """Return the lines of a text with those that go on, which begin with two spaces."""
    return re.sub(r"\n  (?=\S)", " ", text).splitlines()


@pytest.fixture
def command(moved, monkeypatch, capsys):
    """Return a function that runs a command of `moved` in this process: its status and lines."""

    def run(*words):
        args = arguments.read([*words])
        args.config = config.load(moved.config)
        module = import_module(f"pipeline.cli.commands.{words[0]}")
        monkeypatch.setattr(module, "ROOT", moved.path)
        return module.run(args), unwrapped(capsys.readouterr().out)

    return run


def test_an_intact_tree_passes_with_its_results_and_without(moved, command):
    status, lines = command("verify", "--strict")
    assert (status, lines[0], lines[-1]) == (0, "paper_figures/", "14 of 14 files identical")
    shutil.rmtree(moved.path / "results")
    status, lines = command("verify")
    assert status == 1
    words = "and 10 more: not computed here: run ./reproduce, or verify --committed"
    assert lines[-2] == "14 of 14 files identical; 1 other finding"
    assert lines[-1].startswith("exit status 1: paper_figures/: fig2.png") and words in lines[-1]
    status, lines = command("verify", "--committed")
    assert status == 0
    assert lines[-3].startswith("no results here: only the committed files were checked")
    shutil.rmtree(moved.path / "paper_figures")
    status, lines = command("verify", "--committed")
    assert (status, lines[-1]) == (1, "exit status 1: paper_figures/MANIFEST.json: missing")


def test_manifest_and_records_have_no_folder_and_no_date(accepted):
    text = (accepted.path / "paper_figures" / "MANIFEST.json").read_text()
    records = [file.read_text() for file in accepted.path.glob("results/paper/provenance/*.json")]
    assert len(records) >= 10 + 11
    for content in (text, *records):
        assert str(accepted.path) not in content and time.strftime("%Y-") not in content
    assert "commit" not in text
    committed = manifest.read(accepted.path, "paper_figures")
    assert len(committed["results"]) == 12 + 14
    for path in committed["results"]:
        record = read_record(accepted.path, record_path(path))
        whole = manifest.record_of(committed, path)
        assert whole.keys() == {"config", "sources", "inputs", "environment", "output"}
        output = whole["output"] | record["output"]
        assert whole == {name: record[name] for name in whole} | {"output": output}
    assert all({"commit", "dirty"} <= json.loads(record).keys() for record in records)


def test_verify_ends_with_why_it_fails_and_what_to_do(moved, command):
    spoil_pixel(moved.path / FIGURE)
    (moved.path / "paper_figures/mine.png").write_text("x")
    moved.edit("fig7", records=5)
    status, lines = command("verify")
    end = lines[lines.index("11 of 14 files identical; 2 other findings") + 1 :]
    assert status == 1 and end[0] == (
        "exit status 1: paper_figures/: fig3.png, fig7.png, fig7.svg differ"
    )
    assert end[1].startswith("exit status 1: paper_figures/mine.png: no scene makes it")
    assert end[2].startswith("exit status 1: results/paper/lyapunov_fig7.nc")
    assert end[3:] == [WHAT_TO_DO] and WHAT_TO_DO in command("list")[1]


def test_scripts_get_the_findings_and_the_states_as_json(moved, command):
    spoil_pixel(moved.path / FIGURE)
    (moved.path / "paper_figures/mine.png").write_text("x")
    status, lines = command("verify", "--json")
    (found,) = json.loads("\n".join(lines))
    assert (status, found["folder"], len(found["files"])) == (1, "paper_figures", 14)
    different = {name: layers for name, layers in found["files"].items() if layers}
    assert different.keys() == {"fig3.png"} and different["fig3.png"].keys() == {"drawing"}
    assert found["failures"][0].startswith("paper_figures/mine.png: no scene makes it")
    assert found["unchecked"] == [] and isinstance(found["notes"], list)
    status, lines = command("list", "--json", "fig3")
    listed = json.loads("\n".join(lines))
    states = {file["path"]: file["state"] for file in listed}
    keys = {"command", "kind", "variant", "scene", "path", "state"}
    assert status == 0 and all(file.keys() == keys for file in listed)
    assert states[FIGURE] == "differs" and states["paper_figures/fig3.svg"] == "identical"
    assert states[PERIODIC] == "current"
    kinds = {file["path"]: file["kind"] for file in listed}
    assert (kinds[FIGURE], kinds[PERIODIC]) == ("figure", "data")
    assert {file["scene"] for file in listed} == {"fig3"}


SETS_WITH_TEXTS = [name for name, each in SETS.items() if each.texts]


@pytest.mark.parametrize("name", SETS_WITH_TEXTS)
def test_an_edited_text_that_is_published_beside_pictures_is_named(tmp_path, name):
    """As CLAIMS.md and CLAIMS.json, beside more_figures/claims/."""
    checked = config.load(SHIPPED)
    (published_set,) = (s for s in committed_sets(checked) if s.group == name)
    shutil.copytree(ROOT / published_set.folder, tmp_path / published_set.folder)
    for text in published_set.text_files:
        shutil.copy(ROOT / text, tmp_path / text)
    before = Findings(tmp_path, published_set).problems
    for text in published_set.text_files:
        with (tmp_path / text).open("a") as file:
            file.write(" ")
        found = Findings(tmp_path, published_set).problems
        assert [*{*found} - {*before}] == [
            f"{text}: not the committed one: {published_set.command} writes it"
        ]
        shutil.copy(ROOT / text, tmp_path / text)


# ---- one fault for each layer ----


def spoil_pixel(path):
    image = pictures.pixels(path).copy()
    image[100, 200] ^= 255
    path.write_bytes(png(image, 300))


def spoil_value(path):
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_mask(False)
        values = file["strain"][...]
        values.view("i8")[1500] += 3
        file["strain"][...] = values


def spoil_attribute(path):
    with netCDF4.Dataset(path, "a") as file:
        file.setncattr("energy", 0.02)


def save_otherwise(path):
    Image.fromarray(pictures.pixels(path)).save(path, optimize=True)


def cut_to(size):
    return lambda path: path.write_bytes(path.read_bytes()[:size])


def made_thicker(path):
    path.write_text(path.read_text().replace("stroke-width: 0.8", "stroke-width: 0.9", 1))


# Spoiled file, how it is spoiled, the scene or file that differs, its layer with words on it, and
# whether the file is a result, which is then a finding too.
FAULTS = [
    (FIGURE, Path.unlink, "fig3.png", f"file: {FIGURE} is missing: ./reproduce makes it$", False),
    (FIGURE, cut_to(8), "fig3.png", f"drawing: {FIGURE}: damaged, or not", False),
    (FIGURE, save_otherwise, "fig3.png", f"file: {FIGURE}: the same picture in other", False),
    (SVG, made_thicker, "fig7.svg", rf"drawing: {SVG}: 1 of [\d,]+ elements differ", False),
    (DRAWING, spoil_pixel, "fig3.png", rf"drawing: {DRAWING}: 1 of [\d,]+ pixels differ", True),
    (PERIODIC, spoil_attribute, "fig3", f"data: {PERIODIC}: attribute energy differs$", True),
    (ORBITS, cut_to(4000), "fig2", f"data: {ORBITS}: ", True),
    (MOTION, spoil_value, "fig4", rf"data: {MOTION}: variable strain differs$", True),
]


@pytest.fixture(scope="module")
def whole(accepted, tmp_path_factory):
    """A copy of `accepted` for faults that are mended."""
    return accepted.copy(tmp_path_factory.mktemp("verify") / "spoiled")


@pytest.fixture
def mended(whole, accepted, monkeypatch):
    """Return a function that gives the copy, in which the named file is mended afterwards."""
    whole.is_here(monkeypatch)
    files = []
    yield lambda file: files.append(file) or whole
    shutil.copy2(accepted.path / files[0], whole.path / files[0])


@pytest.mark.parametrize(("file", "spoil", "name", "line", "is_result"), FAULTS)
def test_a_spoiled_file_differs_in_its_layer(mended, file, spoil, name, line, is_result):
    moved = mended(file)
    spoil(moved.path / file)
    found = verified(moved)
    assert found.wrong.keys() == ({name} if "." in name else {f"{name}.png", f"{name}.svg"})
    for words in found.wrong.values():
        assert re.match(line, words[0])
    changed = f"{file}: changed after it was made: run ./reproduce"
    assert found.findings[:1] == ([changed] if is_result else [])


def test_another_config_differs_in_the_layer_config(moved):
    moved.edit("fig7", impacts=61)
    found = verified(moved)
    words = ["config: impacts: 60 in the manifest, 61 in config.yaml"]
    assert found.wrong == {"fig7.png": words, "fig7.svg": words} and len(found.findings) == 1
    assert found.findings[0].endswith("made from another config: impacts 60 -> 61: run ./reproduce")


def test_without_results_the_list_asks_the_manifest_for_the_config(moved, command):
    moved.edit("fig7", impacts=61)
    shutil.rmtree(moved.path / "results")
    _, lines = command("list")
    assert "fig7  png svg  stale" in lines
    reason = "stale: impacts 60 -> 61"
    assert f"paper_figures/fig7.png, paper_figures/fig7.svg: {reason}" in lines
    assert "fig3  png svg  identical" in lines


def test_another_source_is_a_note_once_its_results_are_recomputed(moved):
    """Results are stale until they are recomputed; then the changed source is a note."""
    module = "src/pseudorigid/dynamics/orbits.py"
    before = syntax_hash(moved.path / module)
    moved.append("pseudorigid/dynamics/orbits.py")
    found = verified(moved)
    assert (found.status, found.wrong) == (1, {})
    names = ("orbits_fig2", "orbits_fig5", "lyapunov_fig7", "orbits_fig8")
    results = ", ".join(f"results/paper/{name}.nc" for name in names)
    words = f"{results}: made by other code than this tree's: {module} differs: run ./reproduce"
    assert found.findings[0] == words
    figures = "fig2.png, fig2.svg, fig5.png, fig5.svg and 4 more"
    assert found.notes == [f"{figures}: source: {module} differs"]
    after = syntax_hash(moved.path / module)
    for record in (moved.path / "results/paper/provenance").glob("*.json"):
        record.write_text(record.read_text().replace(before, after))  # as a run would write it
    again = verified(moved)
    assert (again.status, again.wrong, again.findings) == (0, {}, []) and again.notes == found.notes
    assert verified(moved, strict=True).status == 1


def test_another_version_of_a_package_differs_in_the_layer_environment(moved, monkeypatch):
    installed = metadata.version
    other = {"matplotlib": "3.0.1"}
    monkeypatch.setattr(metadata, "version", lambda name: other.get(name) or installed(name))
    found = verified(moved)
    assert (found.status, found.wrong) == (1, {})
    # Of what sources import alone: data are made without matplotlib.
    (line,) = (each for each in found.findings if "matplotlib" in each)
    assert re.match(r"\S+\.png, .*: made with matplotlib 3\.\S+ then, 3\.0\.1 here: ", line)
    assert ".nc" not in line
    note = r"environment: matplotlib 3\.\S+ in the manifest, 3\.0\.1 here"
    assert re.search(note, found.notes[0])


def test_a_pixel_that_differs_from_the_results_or_the_commit_is_shown(moved):
    """It is compared with the picture in results or, without results, with the commit."""
    commit(moved.path, "paper_figures")
    spoil_pixel(moved.path / FIGURE)
    found = verified(moved)
    (words,) = found.wrong.pop("fig3.png")
    assert (found.wrong, found.findings, found.notes) == ({}, [], [])
    assert re.match(rf"drawing: {FIGURE}: 1 of [\d,]+ pixels differs: see results/paper/d", words)
    image = pictures.pixels(moved.path / "results" / "paper" / "differences" / "fig3.png")
    assert np.argwhere((image == (220, 0, 0)).all(axis=2)).tolist() == [[100, 200]]
    shutil.rmtree(moved.path / "results")
    assert verified(moved).wrong == {"fig3.png": [words]}
    (moved.path / "paper_figures" / "MANIFEST.json").write_text("{}")
    edited_lists.cache_clear()
    note = "paper_figures/MANIFEST.json: not the committed one, see git diff"
    assert note in verified(moved).notes


def test_without_an_answer_of_git_the_lists_are_not_known_to_be_committed(moved, monkeypatch):
    """As in a tree of another user, whose repository git refuses to read."""
    commit(moved.path, "paper_figures")
    assert verified(moved).notes == []
    edited_lists.cache_clear()
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    found = verified(moved)
    lists = "paper_figures/SHA256SUMS, paper_figures/MANIFEST.json"
    assert found.notes == [f"{lists}: not known to be the committed one, see git status"]
    assert (found.status, verified(moved, strict=True).status) == (0, 1)


@pytest.mark.parametrize("size", [3, 1024, 3000])
def test_a_description_of_data_depends_on_every_value(size):
    def described(at, value):
        values = np.zeros(size)
        values[at] = value
        return manifest.describe_data(xr.Dataset({"x": ("t", values)}))["variables"]["x"]

    first = described(0, 0.0)
    assert described(-1, 0.0) == first
    for at in (0, size // 2, size - 1):
        assert described(at, 1e-300)["sha256"] != first["sha256"]
