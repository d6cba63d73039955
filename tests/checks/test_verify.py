"""verify: each planted fault is named, in its layer, and nothing ends in a traceback."""

import re
import shutil
import subprocess
import sys
import time

import netCDF4
import numpy as np
import pytest
from verdicts import findings, say, verdicts

from pipeline.checks.layers import ulps
from pipeline.checks.verify import verify
from pipeline.records import pictures
from pseudorigid.figures.canvas.render import png

FIG3 = "paper_figures/fig3.png"
PERIODIC = "results/paper/periodic_fig3.nc"
ORBITS = "results/paper/orbits_fig2.nc"


def test_an_intact_tree_passes_in_seconds_wherever_it_is(moved):
    start = time.monotonic()
    result = moved.run("verify")
    assert time.monotonic() - start < 20
    figures, rest = verdicts(result.stdout)
    assert (result.returncode, rest) == (0, ["11 of 11 figures identical"])
    assert set(figures.values()) == {"identical"}
    assert {f"paper_figures/{name}" for name in figures} == {
        f"paper_figures/{name}" for name in moved.published() if "." in name and "json" not in name
    }


def test_sha256sum_passes(moved):
    tool = shutil.which("sha256sum")
    if tool is None:
        pytest.skip("no sha256sum here")
    command = [tool, "--strict", "-c", "SHA256SUMS"]
    subprocess.run(command, cwd=moved.path / "paper_figures", check=True, capture_output=True)


def test_a_clone_without_results_passes_and_says_so(moved):
    shutil.rmtree(moved.path / "results")
    status, text = say(verify, moved)
    assert status == 0, text
    assert "no results here" in text


def test_the_contract_knows_no_place_and_no_day(accepted):
    text = (accepted.path / "paper_figures" / "MANIFEST.json").read_text()
    records = [file.read_text() for file in accepted.path.glob("results/paper/provenance/*.json")]
    assert len(records) == 10 + 11
    for content in (text, *records):
        assert str(accepted.path) not in content
        assert time.strftime("%Y-") not in content
    assert "commit" not in text


# ---- one fault for each layer ----


def test_config(moved):
    moved.edit("fig7", impacts=61)
    figures, _ = findings(moved)
    words = "config: impacts: 60 in the manifest, 61 in config.yaml (the file is as committed)"
    assert figures == {"fig7.png": words, "fig7.svg": words}


def test_a_key_of_an_axis(moved):
    axes = {"impact": {"limits": [0, 200000], "ticks": [0]}}
    axes["exponent"] = {"limits": [-0.5, 0.5], "ticks": [0]}
    moved.edit("fig7", axes=axes)
    figures, _ = findings(moved)
    assert figures["fig7.png"].startswith("config: axes.exponent.limits: ")


def test_a_misspelt_key_is_one_line(moved):
    moved.edit("fig7", impact=61)
    result = moved.run("verify")
    line = "config.yaml: scenes.fig7.impact: unknown key: did you mean impacts?\n"
    assert (result.returncode, result.stdout) == (1, line)


def test_source(moved):
    with (moved.path / "src" / "pseudorigid" / "lyapunov.py").open("a") as file:
        file.write("# edited\n")
    figures, rest = findings(moved)
    assert set(figures) == {"fig7.png", "fig7.svg"}
    for words in figures.values():
        assert words.startswith("source: src/pseudorigid/lyapunov.py differs")
    assert rest == [
        "results/paper/lyapunov_fig7.nc: made by other code than this tree's: "
        "src/pseudorigid/lyapunov.py differs"
    ]


def test_environment(moved):
    """Another matplotlib, as far as its metadata go, found before the installed one."""
    lib = moved.path / "lib"
    about = lib / "matplotlib-3.0.1.dist-info" / "METADATA"
    about.parent.mkdir(parents=True)
    about.write_text("Metadata-Version: 2.1\nName: matplotlib\nVersion: 3.0.1\n")
    start = "import sys, runpy; sys.path.insert(0, sys.argv.pop(1)); "
    start += "sys.argv.pop(0); runpy.run_path(sys.argv[0], run_name='__main__')"
    command = [sys.executable, "-c", start, str(lib), str(moved.path / "workflow" / "launch.py")]
    result = subprocess.run(
        [*command, "verify"], capture_output=True, text=True, cwd="/", check=False
    )
    figures, rest = verdicts(result.stdout)
    assert result.returncode == 1, result.stdout + result.stderr
    assert len(figures) == 11
    for words in figures.values():
        assert re.match(r"environment: matplotlib 3\.\d+\S* in the manifest, 3\.0\.1 here", words)
    assert re.search(r": made with matplotlib 3\.\S+, here is 3\.0\.1$", rest[0])


def change_a_value(path, variable, index, by_ulps):
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_mask(False)
        values = file[variable][...]
        values.view("i8")[index] += by_ulps
        file[variable][...] = values


def test_data(moved, accepted):
    path = moved.path / "results" / "paper" / "orbits_fig5.nc"
    change_a_value(path, "x", 17, 3)
    figures, rest = findings(moved, "--against", str(accepted.path))
    words = figures.pop("fig5.png")
    assert figures == {}
    assert rest == []
    assert words.startswith(
        "data: results/paper/orbits_fig5.nc: variable x differs from block 0 on (value 0 of "
    )
    assert "largest difference 3 ulp, compared with " in words


def test_the_block_is_named(moved):
    """In the middle of 2,000 values; the motion has the longest arrays of the small scenes."""
    path = moved.path / "results" / "paper" / "motion_fig4.nc"
    change_a_value(path, "strain", 1500, 1)
    figures, _ = findings(moved)
    assert set(figures) == {"fig4.png", "fig4.svg"}
    assert "variable strain differs from block 1 on (value 1,024 of " in figures["fig4.png"]


def test_an_edited_attribute(moved):
    with netCDF4.Dataset(moved.path / PERIODIC, "a") as file:
        file.setncattr("energy", 0.02)
    figures, rest = findings(moved)
    words = f"data: {PERIODIC}: attribute energy differs"
    assert figures == {"fig3.png": words, "fig3.svg": words}
    assert rest == []


@pytest.mark.parametrize("keep", [0, 1, 4000, -1])
def test_a_truncated_artifact(moved, keep):
    path = moved.path / ORBITS
    path.write_bytes(path.read_bytes()[:keep])
    figures, rest = findings(moved)
    assert set(figures) == {"fig2.png"}
    assert figures["fig2.png"].startswith(f"data: {ORBITS}: ")
    assert rest == []


def spoil(path, row, column):
    image = pictures.pixels(path).copy()
    image[row, column] ^= 255
    path.write_bytes(png(image, 300))


def test_one_pixel(moved):
    spoil(moved.path / FIG3, 100, 200)
    figures, rest = findings(moved)
    words = figures.pop("fig3.png")
    assert (figures, rest) == ({}, [])
    assert re.match(rf"drawing: {FIG3}: 1 of [\d,]+ pixels differs: see results/paper/diff", words)
    image = pictures.pixels(moved.path / "results" / "paper" / "differences" / "fig3.png")
    red = (image == (220, 0, 0)).all(axis=2)
    assert np.argwhere(red).tolist() == [[100, 200]]


def test_one_pixel_of_a_drawing_that_was_not_published(moved):
    spoil(moved.path / "results" / "paper" / "figures" / "fig3.png", 5, 6)
    figures, rest = findings(moved)
    assert set(figures) == {"fig3.png"}
    assert "drawing: results/paper/figures/fig3.png: 1 of" in figures["fig3.png"]
    assert rest == []


def test_one_pixel_without_results_is_compared_with_the_commit(moved):
    shutil.rmtree(moved.path / "results")
    for command in (["init", "-q"], ["add", "paper_figures"], ["commit", "-q", "-m", "x"]):
        identity = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
        subprocess.run(["git", *identity, *command], cwd=moved.path, check=True)
    spoil(moved.path / FIG3, 100, 200)
    figures, _ = findings(moved)
    assert "1 of" in figures["fig3.png"]


def test_another_svg(moved):
    path = moved.path / "paper_figures" / "fig7.svg"
    path.write_text(path.read_text().replace("stroke-width: 0.8", "stroke-width: 0.9", 1))
    figures, _ = findings(moved)
    assert set(figures) == {"fig7.svg"}
    assert re.search(r"drawing: .*: 1 of [\d,]+ elements differ", figures["fig7.svg"])


def test_file_encoding(moved):
    from PIL import Image

    path = moved.path / FIG3
    Image.fromarray(pictures.pixels(path)).save(path, optimize=True)
    figures, rest = findings(moved)
    assert figures == {"fig3.png": f"file: {FIG3}: the same picture in other bytes"}
    assert rest == []


def test_a_deleted_figure(moved):
    (moved.path / FIG3).unlink()
    figures, rest = findings(moved)
    assert figures == {"fig3.png": f"file: {FIG3} is missing: ./reproduce {FIG3} makes it"}
    assert rest == []


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n", b"garbage"])
def test_a_figure_that_is_none(moved, content):
    for name in ("fig3.png", "fig3.svg"):
        (moved.path / "paper_figures" / name).write_bytes(content)
    figures, rest = findings(moved)
    assert set(figures) == {"fig3.png", "fig3.svg"}
    for name, words in figures.items():
        assert words.startswith(f"drawing: paper_figures/{name}: damaged, or not")
    assert rest == []


# ---- the contract itself ----


def test_every_line_of_the_manifest_counts(moved):
    path = moved.path / "paper_figures" / "MANIFEST.json"
    lines = path.read_text().splitlines(keepends=True)
    package = next(i for i, line in enumerate(lines) if '"matplotlib"' in line)
    digest = next(i for i, line in enumerate(lines) if '"pixels"' in line)
    for missing in (0, package, digest, len(lines) - 1):
        path.write_text("".join(lines[:missing] + lines[missing + 1 :]))
        figures, rest = findings(moved)
        assert len(rest) == 1
        assert rest[0].startswith("paper_figures/MANIFEST.json: ")
        assert set(figures.values()) == {"file: as in SHA256SUMS"}


@pytest.mark.parametrize("content", ["", "[]", "null", "{}", "{", "\0"])
def test_no_manifest_to_speak_of(moved, content):
    (moved.path / "paper_figures" / "MANIFEST.json").write_text(content)
    _, rest = findings(moved)
    assert rest[0].startswith("paper_figures/MANIFEST.json: ")


def test_sums_with_a_missing_or_broken_line(moved):
    path = moved.path / "paper_figures" / "SHA256SUMS"
    text = path.read_text()
    lines = text.splitlines(keepends=True)
    path.write_text("".join(line for line in lines if "fig3.svg" not in line))
    assert findings(moved) == ({}, ["paper_figures/SHA256SUMS: no line for fig3.svg"])
    path.write_text(text.replace(lines[0][:64], "0" * 64))
    name = lines[0].split()[1]
    said = f"paper_figures/SHA256SUMS: not the hash of {name} that MANIFEST.json has"
    assert findings(moved) == ({}, [said])
    path.write_text("not a sum\n")
    said = "paper_figures/SHA256SUMS: line 1 is not a sha256 and a file's name"
    assert findings(moved) == ({}, [said])
    path.unlink()
    assert findings(moved) == ({}, ["paper_figures/SHA256SUMS: missing"])


def test_a_figure_that_no_scene_makes(moved):
    shutil.copy(moved.path / FIG3, moved.path / "paper_figures" / "fig9.png")
    said = "paper_figures/fig9.png: no scene of config.yaml makes it"
    assert findings(moved) == ({}, [said])


def test_ulps():
    a = np.array([1.0, -0.0, 5e-324, -1.0, np.nan, np.inf])
    b = np.array([np.nextafter(1.0, 2.0), 0.0, -5e-324, 1.0, np.nan, np.finfo(float).max])
    between = 2 * int(np.array(1.0).view("i8"))
    assert ulps(a, b).tolist() == [1, 0, 2, between, 0, 1]
