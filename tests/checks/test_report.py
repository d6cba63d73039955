"""The report: one page that needs nothing else, with every figure and the numbers in it."""

import base64
import json
import re
import shutil
import subprocess

import pytest
from project import Tree, fresh_tree, shipped, small

from pipeline import config
from pipeline.checks import report
from pipeline.config import places
from pipeline.config.declared.kinds import KINDS
from pipeline.records.artifacts import load
from pipeline.records.pictures import pixels

PAGE = "results/report/report.html"
CHROMIUM = shutil.which("chromium")

# Clicks through the list of figures and keeps what each click brought up.
CLICKS = """
const wait = ms => new Promise(done => setTimeout(done, ms));
const found = [];
(async () => {
  await wait(500);
  [...document.querySelectorAll("a")].find(a => a.textContent.trim() == "Figures").click();
  await wait(300);
  for (const row of document.querySelectorAll("table tbody tr")) {
    row.querySelector("a, button").click();
    await wait(500);
    const shown = [...document.images].filter(i => i.src.startsWith("data:image/png"));
    found.push([row.textContent, ...shown.map(i => [i.naturalWidth, i.naturalHeight])]);
  }
  const note = document.createElement("pre");
  note.id = "found";
  note.textContent = JSON.stringify(found);
  document.body.appendChild(note);
})();
"""


def make(folder):
    """Three small scenes and their report."""
    document = small(shipped())
    document.pop("variants")
    document["scenes"] = {name: document["scenes"][name] for name in ("fig3", "fig6", "fig7")}
    tree = fresh_tree(folder, document)
    result = tree.run("report")
    assert result.returncode == 0, result.stdout
    (folder / "said").write_text(result.stdout)


@pytest.fixture(scope="module")
def reported(shared):
    return Tree(shared("reported in a folder with spaces", make))


def test_every_figure_is_in_the_page_byte_for_byte(reported):
    text = (reported.path / PAGE).read_text()
    figures = sorted((reported.path / "results" / "paper" / "figures").glob("*.png"))
    assert [path.name for path in figures] == ["fig3.png", "fig6.png", "fig7.png"]
    for path in figures:
        assert base64.b64encode(path.read_bytes()).decode() in text
    assert (reported.path / "said").read_text().splitlines()[-1].startswith(f"{PAGE}  ")


def test_the_page_loads_nothing_from_elsewhere(reported):
    text = (reported.path / PAGE).read_text()
    assert not re.findall(r"<(?:script|img|iframe)[^>]+src=[\"']?(?:https?:)?//", text)
    assert not re.findall(r"<link[^>]+href=[\"']?(?:https?:)?//", text)


def test_each_figure_has_a_caption_and_its_numbers(reported):
    text = (reported.path / PAGE).read_text()
    for words in ("the two lines touch", "The surroundings of one point", "What to see"):
        assert words in text
    labels = json.loads((reported.path / "results" / "report" / "labels.json").read_text())
    assert set(labels) == {"fig3", "fig6", "fig7"}
    assert labels["fig3"] == "fig3: orbit elliptic, period 1 (the paper: elliptic, period one)"
    assert labels["fig6"].endswith("(the paper: between 0.21 and 0.2116)")
    assert 0.21 < float(re.search(r"point ([0-9.]+)", labels["fig6"])[1]) < 0.2116
    assert all(label in text for label in labels.values())


def test_numbers_and_provenance_are_tables(reported):
    numbers = (reported.path / "results" / "report" / "numbers.html").read_text()
    assert "<td>approximately 0.235</td>" in numbers
    assert "<td>between 0.0925 and 0.0932</td><td>0.09" in numbers
    provenance = (reported.path / "results" / "report" / "provenance.html").read_text()
    record = reported.path / "results" / "paper" / "provenance" / "fig3.png.json"
    assert json.loads(record.read_text())["output"]["sha256"] in provenance
    assert "8 of these files made with deflate" in provenance


def test_nothing_half_made_stays(reported):
    assert not list((reported.path / "results" / "report").glob("*part*"))


def test_a_page_escapes_what_it_shows():
    assert "<td>&lt;b&gt;</td>" in report.page("t", ("h",), [("<b>",)])


def test_every_kind_of_picture_has_a_caption_and_a_telling_number(finished):
    """Of each kind a scene of a finished copy: the telling number is among its numbers."""
    scenes = config.load(finished.config)["scenes"]
    rows = report.numbers(
        scenes, lambda scene, stage: load(finished.path / served(scenes)[scene, stage])
    )
    assert {block["picture"] for block in scenes.values()} <= set(KINDS)
    for scene, block in scenes.items():
        kind = KINDS[block["picture"]]
        assert kind.telling in {quantity for quantity, *_ in rows[scene]}
        assert "What to see:" in kind.caption()
        assert report.label(scene, block["picture"], rows[scene]).startswith(f"{scene}: ")


def served(scenes):
    """(scene, stage) -> dataset of the paper's scenes."""
    return {
        (scene, stage): path
        for (_, scene, stage), path in places.served({config.PAPER: scenes}).items()
    }


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
def test_every_figure_loads_in_a_browser(reported, tmp_path):
    text = (reported.path / PAGE).read_text()
    end = text.rindex("</body>")
    page = tmp_path / "page.html"
    page.write_text(text[:end] + f"<script>{CLICKS}</script>" + text[end:])
    command = [
        CHROMIUM,
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        f"--user-data-dir={tmp_path}",
    ]
    command += ["--virtual-time-budget=20000", "--dump-dom", page.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout
    found = json.loads(re.search(r'<pre id="found">(.*?)</pre>', dom)[1])
    assert [entry[0][:4] for entry in found] == ["fig3", "fig6", "fig7"]
    for name, *images in found:
        path = reported.path / "results" / "paper" / "figures" / f"{name[:4]}.png"
        high, wide, _ = pixels(path).shape
        assert images == [[wide, high]]
