"""verify names each planted fault in its layer."""

import re
import shutil
import time
from importlib import metadata

import netCDF4
import numpy as np
import pytest
from verdicts import commit, verified

from pipeline.checks.published_sets import edited_lists
from pipeline.records import pictures
from pipeline.records.sources import syntax_hash
from pseudorigid.figures.canvas.render import png

FIG3 = "paper_figures/fig3.png"
PERIODIC = "results/paper/periodic_fig3.nc"
ORBITS = "results/paper/orbits_fig2.nc"
MOTION = "results/paper/motion_fig4.nc"  # has the longest arrays
CHANGED = "changed after it was made: run ./reproduce"


def test_an_intact_tree_passes_with_its_results_and_without(moved):
    result = moved.run("verify")
    assert result.returncode == 0, result.stdout
    assert result.stdout.splitlines()[-1] == "14 of 14 figures identical"
    assert verified(moved)[:4] == (0, {}, [], [])
    shutil.rmtree(moved.path / "results")
    bare = moved.run("verify")
    assert bare.returncode == 1
    assert "not computed here: run ./reproduce, or verify --committed" in bare.stdout
    assert moved.run("verify", "--committed").returncode == 0
    found = verified(moved, committed=True)
    assert found[:4] == (0, {}, [], [])
    assert found.lines[-2].startswith("no results here: only the committed files were checked")


def test_manifest_and_records_have_no_folder_and_no_date(accepted):
    text = (accepted.path / "paper_figures" / "MANIFEST.json").read_text()
    records = [file.read_text() for file in accepted.path.glob("results/paper/provenance/*.json")]
    assert len(records) >= 10 + 11
    for content in (text, *records):
        assert str(accepted.path) not in content
        assert time.strftime("%Y-") not in content
    assert "commit" not in text


# ---- one fault for each layer ----


def test_another_config_differs_in_the_layer_config(moved):
    moved.edit("fig7", impacts=61)
    found = verified(moved)
    words = ["config: impacts: 60 in the manifest, 61 in config.yaml"]
    assert found.wrong == {"fig7.png": words, "fig7.svg": words}
    assert len(found.findings) == 1
    assert found.findings[0].endswith("made from another config: impacts 60 -> 61: run ./reproduce")


def test_without_results_the_list_asks_the_manifest_for_the_config(moved):
    moved.edit("fig7", impacts=61)
    shutil.rmtree(moved.path / "results")
    listed = moved.run("list").stdout
    assert "fig7  paper_figures/fig7.png  stale: impacts 60 -> 61\n" in listed
    assert f"fig3  {FIG3}  identical to the committed one\n" in listed


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
    assert (again.status, again.wrong, again.findings) == (0, {}, [])
    assert again.notes == found.notes
    assert verified(moved, strict=True).status == 1


def test_another_version_of_a_package_differs_in_the_layer_environment(moved, monkeypatch):
    installed = metadata.version
    other = {"matplotlib": "3.0.1"}
    monkeypatch.setattr(metadata, "version", lambda name: other.get(name) or installed(name))
    found = verified(moved)
    assert (found.status, found.wrong) == (1, {})
    assert re.search(r"\.nc.*: made with matplotlib 3\.\S+ then, 3\.0\.1 here: ", found.findings[0])
    note = r"environment: matplotlib 3\.\S+ in the manifest, 3\.0\.1 here"
    assert re.search(note, found.notes[0])


@pytest.mark.parametrize(
    ("path", "variable", "index", "figure", "block"),
    [
        ("results/paper/orbits_fig5.nc", "x", 17, "fig5", "block 0 on (value 0 of "),
        (MOTION, "strain", 1500, "fig4", "block 1 on (value 1,024 of "),
    ],
)
def test_a_value_that_differs_is_located(moved, path, variable, index, figure, block):
    with netCDF4.Dataset(moved.path / path, "a") as file:
        file.set_auto_mask(False)
        values = file[variable][...]
        values.view("i8")[index] += 3
        file[variable][...] = values
    found = verified(moved)
    assert found.wrong.keys() == {f"{figure}.png", f"{figure}.svg"}
    for (words,) in found.wrong.values():
        assert words.startswith(f"data: {path}: variable {variable} differs from {block}")
    assert found.findings[0] == f"{path}: {CHANGED}"


def test_an_edited_attribute_is_named(moved):
    with netCDF4.Dataset(moved.path / PERIODIC, "a") as file:
        file.setncattr("energy", 0.02)
    found = verified(moved)
    words = [f"data: {PERIODIC}: attribute energy differs"]
    assert found.wrong == {"fig3.png": words, "fig3.svg": words}
    assert found.findings[0] == f"{PERIODIC}: {CHANGED}"


@pytest.mark.parametrize("keep", [0, 1, 4000, -1])
def test_a_truncated_dataset_differs_in_the_layer_data(moved, keep):
    path = moved.path / ORBITS
    path.write_bytes(path.read_bytes()[:keep])
    found = verified(moved)
    assert set(found.wrong) == {"fig2.png", "fig2.svg"}
    assert found.wrong["fig2.png"][0].startswith(f"data: {ORBITS}: ")


def spoil(path, row, column):
    image = pictures.pixels(path).copy()
    image[row, column] ^= 255
    path.write_bytes(png(image, 300))


def test_a_pixel_that_differs_from_the_results_or_the_commit_is_shown(moved):
    """It is compared with the picture in results or, without results, with the commit."""
    commit(moved.path, "paper_figures")
    spoil(moved.path / FIG3, 100, 200)
    found = verified(moved)
    (words,) = found.wrong.pop("fig3.png")
    assert (found.wrong, found.findings, found.notes) == ({}, [], [])
    assert re.match(rf"drawing: {FIG3}: 1 of [\d,]+ pixels differs: see results/paper/diff", words)
    image = pictures.pixels(moved.path / "results" / "paper" / "differences" / "fig3.png")
    assert np.argwhere((image == (220, 0, 0)).all(axis=2)).tolist() == [[100, 200]]
    shutil.rmtree(moved.path / "results")
    assert verified(moved).wrong == {"fig3.png": [words]}
    (moved.path / "paper_figures" / "MANIFEST.json").write_text("{}")
    edited_lists.cache_clear()
    note = "paper_figures/MANIFEST.json: not the committed one, see git diff"
    assert note in verified(moved).notes


def test_a_pixel_that_differs_in_an_unpublished_drawing_is_counted(moved):
    drawing = "results/paper/figures/fig3.png"
    spoil(moved.path / drawing, 5, 6)
    found = verified(moved)
    (words,) = found.wrong.pop("fig3.png")
    assert f"drawing: {drawing}: 1 of" in words
    assert (found.wrong, found.findings) == ({}, [f"{drawing}: {CHANGED}"])


def test_an_element_of_an_svg_that_differs_is_counted(moved):
    path = moved.path / "paper_figures" / "fig7.svg"
    path.write_text(path.read_text().replace("stroke-width: 0.8", "stroke-width: 0.9", 1))
    found = verified(moved)
    assert set(found.wrong) == {"fig7.svg"}
    assert re.search(r"drawing: .*: 1 of [\d,]+ elements differ", found.wrong["fig7.svg"][0])


def test_the_same_picture_in_other_bytes_differs_in_the_layer_file(moved):
    from PIL import Image

    path = moved.path / FIG3
    Image.fromarray(pictures.pixels(path)).save(path, optimize=True)
    found = verified(moved)
    assert found.wrong == {"fig3.png": [f"file: {FIG3}: the same picture in other bytes"]}
    assert found.findings == []
