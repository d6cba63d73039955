"""The page is one file with the same bytes everywhere, which nothing from elsewhere can reach."""

import base64
import hashlib
import json
import os
import re
import shutil
import sys
from contextlib import nullcontext

import numpy as np
import pytest

from extensions.explorer import command as explore
from extensions.explorer import data, page
from extensions.explorer.command import EXPLORER
from helpers.project import ROOT, SHIPPED, run
from pipeline import config
from pipeline.checks.manifest import describe_data
from pipeline.cli.arguments import Arguments
from pipeline.config.schema.kinds import KINDS
from pipeline.records.artifacts import load


@pytest.fixture(scope="module")
def text():
    return page.render(config.load(SHIPPED))


def scenes_of(text):
    """The scenes in a page's data."""
    (stored,) = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text)
    return json.loads(stored)["scenes"]


def packed(checked):
    """The page, made from its sources."""
    return page._with_data(page._packed(), checked, ROOT)


def test_the_committed_copy_is_current(text):
    """Renew it by .venv/bin/python -m pipeline.renew."""
    assert (ROOT / page.COPY).read_text(encoding="utf-8") == text
    pytest.importorskip("minify")  # it has no wheel for some machines
    assert packed(config.load(SHIPPED)) == text


@pytest.mark.parametrize("place", ["WEB", "ROOT"])
def test_a_copy_of_other_sources_is_refused(monkeypatch, tmp_path, place):
    """Without the package that packs a page, since no other command than renew has it."""
    monkeypatch.setitem(sys.modules, "minify", None)
    checked = config.load(SHIPPED)
    page.render(checked)
    file = getattr(page, place) / {"WEB": "main.js", "ROOT": "requirements/explorer.txt"}[place]
    edited = file.read_text() + "\n// edited\n"
    whole = page.read_text
    monkeypatch.setattr(page, "read_text", lambda path: edited if path == file else whole(path))
    with pytest.raises(ValueError, match=r"explorer.html was made from other files .*renew$"):
        page.render(checked)


def test_only_the_scripts_of_the_page_may_run(text):
    """Browsers refuse whatever this policy does not name: test_check.py."""
    (policy,) = re.findall(r'"Content-Security-Policy" content="([^"]*)"', text)
    parts = re.findall(r'<script(?: id="kernel")?>(.*?)</script>', text, re.DOTALL)
    parts += re.findall(r"<style>(.*?)</style>", text, re.DOTALL)
    digests = [base64.b64encode(hashlib.sha256(part.encode()).digest()).decode() for part in parts]
    kernel, app, style = (f"'sha256-{digest}'" for digest in digests)
    assert policy.split("; ") == [
        "default-src 'none'",
        f"script-src 'wasm-unsafe-eval' {kernel} {app}",
        f"style-src {style}",
        "worker-src blob:",
        "img-src data: blob:",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    before = text[: text.index("Content-Security-Policy")]
    assert "<script" not in before and "<style" not in before


@pytest.mark.slow
def test_the_bytes_are_the_same_elsewhere(text, tmp_path):
    """Another folder, locale, time zone and order of sets."""
    tree = tmp_path / "another place"
    shutil.copytree(ROOT / "src", tree / "src", ignore=shutil.ignore_patterns("*.nb?"))
    shutil.copytree(ROOT / "paper_figures", tree / "paper_figures")
    shutil.copytree(ROOT / "requirements", tree / "requirements")
    for file in ("pyproject.toml", "CITATION.cff"):
        shutil.copy(ROOT / file, tree)
    shutil.copy(SHIPPED, tree / "config.yaml")
    settings = {"PYTHONHASHSEED": "1", "LC_ALL": "C", "TZ": "Asia/Tokyo", "PYTHONUTF8": "0"}
    pytest.importorskip("minify")
    program = "import sys, extensions.explorer.page as page\n"
    program += "sys.stdout.buffer.write(page._packed().encode())"
    settings |= {"PYTHONPATH": str(tree / "src")}
    how = {"env": os.environ | settings, "cwd": tmp_path, "text": False}
    assert run(sys.executable, "-c", program, **how).stdout == page._packed().encode()


def test_scenes_of_all_variants_open_unless_their_orbits_are_others(text):
    checked = config.load(SHIPPED)
    variants = checked.variants
    scenes = scenes_of(text)
    assert {"fig2", "jumps", "curves", "below/fig8", "thin-shell/fig2"} <= set(scenes)
    assert "families" not in scenes and not any("exact" in name for name in scenes)
    assert scenes["thin-shell/fig2"]["ball"]["k"] == 0.3333333333333333
    for variant, blocks in variants.items():
        for scene, block in ((name, each.as_mapping()) for name, each in blocks.items()):
            assert (data.address(checked, variant, scene, block) in scenes) == (
                "method" not in block and KINDS[block["picture"]].on_section
            )


def test_scenes_of_two_sets_with_one_name_open_apart():
    document = config.load(SHIPPED)
    other = document.variants["paper"]["fig2"]
    document.variants["paper"]["curves"] = other
    scenes = data.collect(document)["scenes"]
    pictures = [scenes[name]["picture"] for name in ("curves", "proofs/curves")]
    assert pictures == ["portrait", "curves"]


def test_every_kind_of_picture_with_a_section_has_a_preset():
    """A new kind needs a function in presets.js of its part."""
    functions = re.findall(r"^  (\w+)[:(]", page.script(page.PRESETS), re.MULTILINE)
    assert set(functions) == {name for name, kind in KINDS.items() if kind.on_section}
    scenes = data.collect(config.load(SHIPPED))
    own = {name for name in scenes["scenes"] if "/" not in name}
    assert {preset["name"] for preset in scenes["presets"]} == own


def test_data_cannot_end_their_script(text):
    document = config.load(SHIPPED)
    document.variants["paper"]["fig3"].type = "</script><script>alert(1)"
    stored = scenes_of(page.render(document))
    assert stored["fig3"]["type"] == "</script><script>alert(1)"


def test_the_atlas_has_the_values_of_a_sweep():
    """Each share is rounded to a step; one that is missing stays so."""
    stored = data.stored_atlas()
    k, energy = (np.array(stored[name]) for name in ("k", "energy"))
    steps = np.frombuffer(base64.b64decode(stored["regular"]), np.uint8)
    assert steps.size == k.size * energy.size
    assert np.all(np.diff(k) > 0) and np.all(np.diff(energy) > 0)
    assert np.all((steps <= data.STEPS) | (steps == data.MISSING))
    sweep = ROOT / "results/atlas/sweep_plane.nc"
    committed = json.loads((ROOT / "more_figures/atlas/MANIFEST.json").read_text())["results"]
    output = committed[str(sweep.relative_to(ROOT))]["output"]
    if sweep.is_file() and output == output | describe_data(load(sweep)):
        assert data.rounded_atlas().items() <= stored.items()


@pytest.mark.parametrize(
    ("display", "no_open", "done"), [(":0", False, "opened"), ("", False, "open it")]
)
def test_explore_writes_the_page_and_opens_it(
    monkeypatch, tmp_path, capsys, text, display, no_open, done
):
    for name in ("WAYLAND_DISPLAY", "BROWSER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("DISPLAY", display)
    opened = []
    monkeypatch.setattr(explore, "ROOT", tmp_path)
    monkeypatch.setattr(explore, "locked", nullcontext)
    monkeypatch.setattr(page, "render", lambda checked: text)
    monkeypatch.setattr(explore.webbrowser, "open", lambda uri: opened.append(uri) or True)
    assert explore.run(Arguments(no_open=no_open, config={})) == 0
    assert (tmp_path / EXPLORER).read_text(encoding="utf-8") == text
    assert opened == [(tmp_path / EXPLORER).as_uri()] * (done == "opened")
    size = f"{len(text.encode()) / 1e6:.1f} MB"
    assert capsys.readouterr().out == f"{EXPLORER}  {size}: {done} in a browser\n"


@pytest.mark.slow
def test_an_edit_of_the_kernel_asks_for_another_module(tree):
    file = tree.path / "src/pseudorigid/kernel/flight.py"
    text = file.read_text()
    assert text.count("h4 = h2 * h2") == 1
    file.write_text(text.replace("h4 = h2 * h2", "h4 = h2 * h2 + 0.0"))
    result = tree.run("explore", "--no-open")
    line = r"reproduce: src/\S+ is not what the kernel gives: run \S+ -m pipeline\.renew\n"
    assert result.returncode == 1 and re.fullmatch(line, result.stdout)
