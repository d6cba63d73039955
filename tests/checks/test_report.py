"""The report: one page that needs nothing else, with every figure and what was measured in it."""

import base64
import hashlib
import json
import re
import shutil
import subprocess
from collections import Counter
from html.parser import HTMLParser
from itertools import pairwise

import pytest
from project import ROOT, Tree, fresh_tree, shipped, small

from pipeline import config
from pipeline.checks import claims, published_sets
from pipeline.checks.claims import ledger
from pipeline.checks.claims.schema import CORRECTED, FALSE
from pipeline.checks.report import numbers, page
from pipeline.config import paths
from pipeline.config.schema.kinds import KINDS
from pipeline.records.artifacts import load
from pipeline.records.pictures import pixels

PAGE = "results/report/report.html"
CHROMIUM = shutil.which("chromium")
# What a browser found: how wide the page is, and of which size its pictures are.
LOOK = """
const note = document.createElement("pre");
note.id = "found";
note.textContent = JSON.stringify({
  room: document.documentElement.clientWidth,
  needed: document.documentElement.scrollWidth,
  images: [...document.images].map(i => [i.naturalWidth, i.naturalHeight]),
  requests: performance.getEntriesByType("resource").map(r => r.name.slice(0, 5)),
});
document.body.appendChild(note);
"""


def make(folder):
    """Three small scenes, one of them in a variant too, and their report."""
    document = small(shipped())
    document["variants"] = {"lower": {"energy": 0.0098, "scenes": {"fig3": {"duration": 9}}}}
    document["scenes"] = {name: document["scenes"][name] for name in ("fig3", "fig6", "fig7")}
    tree = fresh_tree(folder, document)
    shutil.copy(ROOT / "CLAIMS.json", folder)
    made = tree.run("results/lower/figures/fig3.png")
    assert made.returncode == 0, made.stdout
    result = tree.run("report")
    assert result.returncode == 0, result.stdout
    (folder / "said").write_text(result.stdout)


@pytest.fixture(scope="module")
def reported(shared):
    return Tree(shared("reported in a folder with spaces", make))


@pytest.fixture(scope="module")
def text(reported):
    return (reported.path / PAGE).read_text(encoding="utf-8")


class Outline(HTMLParser):
    """The tags of a page with their attributes, and that each is closed."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.open = [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "link", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, self.getpos()

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def rendered(tree):
    checked = config.load(tree.config)
    return page.render(tree.path, checked, {})


def test_every_figure_is_in_the_page_byte_for_byte(reported, text):
    figures = sorted((reported.path / "results" / "paper" / "figures").glob("*.png"))
    assert [path.name for path in figures] == ["fig3.png", "fig6.png", "fig7.png"]
    figures += [reported.path / "results" / "lower" / "figures" / "fig3.png"]
    for path in figures:
        assert text.count(base64.b64encode(path.read_bytes()).decode()) == 1
    assert (reported.path / "said").read_text().splitlines()[-1].startswith(f"{PAGE}  ")


def test_the_page_asks_nothing_of_a_network(text):
    outline = Outline(text)
    policy = [a["content"] for a in outline.all("meta") if "http-equiv" in a]
    assert policy == ["default-src 'none'; img-src data:; style-src 'unsafe-inline'"]
    assert all(a["src"].startswith("data:image/png;base64,") for a in outline.all("img"))
    assert [a["href"] for a in outline.all("link")] == ["data:,"]
    assert not outline.all("script") and "@import" not in text and "url(" not in text


def test_links_lead_somewhere_and_pictures_have_words(text):
    outline = Outline(text)
    ids = Counter(a["id"] for _, a in outline.tags if "id" in a)
    assert set(ids.values()) == {1}
    links = [a["href"] for a in outline.all("a")]
    assert links[0] == "#main"  # the skip link comes first
    assert {link[0] for link in links} == {"#"} and {link[1:] for link in links} <= set(ids)
    assert all(len(a["alt"]) > 40 and a["width"] and a["height"] for a in outline.all("img"))
    levels = [int(tag[1]) for tag, _ in outline.tags if re.fullmatch(r"h\d", tag)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))
    assert outline.all("html") == [{"lang": "en"}]


def test_each_figure_has_its_caption_and_numbers(text):
    for words in ("The two lines touch", "The surroundings of one point", "What to see"):
        assert words in text
    assert "<td>approximately 0.235</td><td>0." in text
    assert "<td>between 0.0925 and 0.0932</td><td>0.09" in text
    assert "<td>0.21 to 0.2116</td><td>0.21 to 0.2116</td>" in text
    assert "orbit: elliptic, period 1 (at the paper" in text  # of the variant


def test_corrections_first_and_the_whole_table(text):
    rows = ledger.read_json((ROOT / "CLAIMS.json").read_text(encoding="utf-8"))
    wrong = [row for row in rows if row.verdict in (FALSE, CORRECTED)]
    assert len(rows) == len(claims.CLAIMS) and 0 < len(wrong) < len(claims.CLAIMS)
    above, _, whole = text.partition('id="claims"')
    assert {f'href="#claim-{row.number}"' for row in wrong} == set(
        re.findall(r'href="#claim-\d+"', above)
    )
    assert len(re.findall(r'<tr role="row" id="claim-\d+">', whole)) == len(claims.CLAIMS)


def test_provenance_and_seconds(reported, text):
    record = reported.path / "results" / "paper" / "provenance" / "fig3.png.json"
    assert json.loads(record.read_text())["output"]["sha256"] in text
    made = re.findall(r'class="break">(results/\S+)</th>.*data-label="seconds">([^<]*)<', text)
    assert len(made) == 11 and all(re.fullmatch(r"\d+\.\d", seconds) for _, seconds in made)


def test_the_same_page_again_but_for_the_seconds(reported, text, tmp_path):
    assert rendered(reported) == text
    bare = reported.copy(tmp_path / "elsewhere")
    for path in bare.path.glob("results/*/provenance/*.json"):
        record = json.loads(path.read_text())
        path.write_text(json.dumps(record | {"seconds": "many"}))
    other = rendered(bare)
    assert "not known" in other
    timed = re.compile(r'data-label="seconds">[^<]*<')
    assert timed.sub("", other) == timed.sub("", text)


def test_a_page_without_claims_or_variants(reported, tmp_path):
    tree = reported.copy(tmp_path / "poor")
    (tree.path / "CLAIMS.json").write_text("nothing <b> of the kind")
    shutil.rmtree(tree.path / "results" / "lower")
    text = rendered(tree)
    Outline(text)
    assert "There is no <code>CLAIMS.json</code> that can be read" in text
    assert "this tree made: lower" in text and '<h2 id="variants"' not in text


def test_a_figure_that_is_not_current_is_not_shown(reported, tmp_path):
    tree = reported.copy(tmp_path / "damaged")
    with open(tree.path / "results" / "paper" / "lyapunov_fig7.nc", "r+b") as file:
        file.truncate(1000)
    text = rendered(tree)
    Outline(text)
    assert re.search(
        r"<p>No picture: not current: made from \S* ?results/paper/lyapunov_fig7.nc", text
    )
    assert "<td>approximately 0.235" not in text


def shown(tree, name):
    """The article of a committed picture in the page of a tree, without its bytes, or None."""
    text = re.sub('base64,[^"]*', "base64,", rendered(tree))
    Outline(text)
    found = re.search(f'<article id="more_figures-{name}[.]png".*?</article>', text, re.DOTALL)
    return found and found.group()


def test_committed_pictures_are_shown_where_the_tree_made_none(reported, tmp_path):
    tree = reported.copy(tmp_path / "committed")
    pictures = sorted((ROOT / "more_figures").glob("*/*.png"))
    shutil.copy(ROOT / "tests" / "scenes.yaml", tree.config)
    assert shown(tree, "claims-flux") is None
    shutil.copytree(ROOT / "more_figures", tree.path / "more_figures", dirs_exist_ok=True)
    for folder in (tree.path / "more_figures").iterdir():  # whatever stands there at the moment
        files = sorted(folder.glob("*.png"))
        sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files]
        (folder / "SHA256SUMS").write_text("".join(sums))
    text = rendered(tree)
    for path in pictures:
        assert text.count(base64.b64encode(path.read_bytes()).decode()) == 1, path
        article = shown(tree, f"{path.parent.name}-{path.stem}")
        assert f"{path.parent.name}/{path.name}: the committed one (" in article
    assert "no hash of measurements is kept" in shown(tree, "study-seconds_grazing")
    # Its caption would have values that it was not made from.
    (tree.path / "more_figures" / "claims" / "MANIFEST.json").unlink()
    assert "other values than config.yaml" in shown(tree, "claims-flux")
    with open(tree.path / "more_figures" / "claims" / "flux.png", "ab") as file:
        file.write(b"x")
    assert "<p>No picture: more_figures/claims/flux.png is not the" in shown(tree, "claims-flux")
    assert "<img" not in shown(tree, "claims-flux")


def test_whole_numbers_have_commas_throughout(reported):
    block = {"energy": 0.01, "ball": {"k": 0.2, "g": 0.04}, "starts": [0.1, 0.2]}
    about = page._Page._about
    some = block | {"picture": "portrait", "impacts": [20000, 25000]}
    assert "of 45,000 impacts in all" in about(None, "fig2", some)["shows"]
    assert (
        "up to 200,000, at"
        in about(None, "f", some | {"picture": "exponents", "impacts": 200000})["shows"]
    )
    text = re.sub(
        '<style>.*?</style>|base64,[^"]*|<[^>]*>', " ", rendered(reported), flags=re.DOTALL
    )
    text = text.partition("What made each result")[0]
    assert not re.findall(r"(?<![\d.,])\d{5,}(?![\d.,])", text)


def test_what_cannot_exist_is_said(reported):
    checked = config.load(reported.config)
    text = page.render(reported.path, checked, {"paper": {"fig6": "no hyperbolic orbit"}})
    Outline(text)
    assert "<p>No picture: no hyperbolic orbit.</p>" in text and 'alt="Figure 6' not in text


def test_every_chart_has_words():
    checked = config.load(ROOT / "tests" / "scenes.yaml")
    scenes = {
        scene
        for published_set in published_sets.committed_sets(checked)
        for scene in published_set.scenes.values()
        if published_set.folder.rpartition("/")[2] in ("study", "atlas")
    }
    assert len(scenes) >= 8 and scenes <= set(numbers.CHARTS)


def artifact_paths(scenes):
    """(scene, stage) -> dataset of the paper's scenes."""
    return {
        (scene, stage): path
        for (_, scene, stage), path in paths.artifact_paths({config.PAPER: scenes}).items()
    }


def test_every_kind_has_a_caption_and_measures(finished):
    """Of each of the paper's kinds: what is shown comes from the data, not from the config."""
    scenes = config.load(finished.config)["scenes"]
    where = artifact_paths(scenes)
    for scene, block in scenes.items():
        kind = KINDS[block["picture"]]
        data = {stage: load(finished.path / where[scene, stage]) for stage in paths.stages(block)}
        ours = numbers.measured(block, data.__getitem__)
        assert kind.headline in ours and "What to see:" in kind.caption()
        assert set(numbers.PAPER_NUMBERS[scene]) <= set(ours)
        told = block | {"energy": 0.5, "impacts": 3, "starts": [0.1], "duration": 1.0}
        told |= {"window": {"x": [0, 1], "xdot": [0, 1]}, "length": 9, "period": 99}
        assert numbers.measured(told, data.__getitem__) == ours


def test_other_data_other_numbers(finished):
    scenes = config.load(finished.config)["scenes"]
    where = artifact_paths(scenes)

    def measured(scene, **changes):
        stages = paths.stages(scenes[scene])
        data = {stage: load(finished.path / where[scene, stage]) for stage in stages}
        for stage, change in changes.items():
            data[stage] = change(data[stage])
        return numbers.measured(scenes[scene], data.__getitem__)

    shifted = measured("fig6", manifolds=lambda d: d.assign_attrs(point_x=0.3, window_x=[0.2, 0.4]))
    assert shifted["x of the point"] == "0.3000000" and shifted["window, x"] == "0.2 to 0.4"
    faster = measured("fig2", orbits=lambda d: d.assign(xdot=d["xdot"] * 1.1))
    assert faster["energy"] != measured("fig2")["energy"] == "0.01"
    other = measured("fig7", lyapunov=lambda d: d.assign(exponent=d["exponent"] + 1.0))
    assert all(float(value) > 1.0 for value in other["largest exponent"].split(", "))


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
@pytest.mark.parametrize("width", [1280, 390])
def test_in_a_browser(reported, text, tmp_path, width):
    """In a frame of this width, as chromium's own windows are no narrower than 500 pixels."""
    inner, outer = tmp_path / "page.html", tmp_path / "outer.html"
    inner.write_text(
        re.sub(r"<meta http-equiv[^>]*>", "", text).replace("</body>", f"<script>{LOOK}</script>")
    )
    outer.write_text(
        f'<iframe src="page.html" width="{width}" height="900" style="border:0"></iframe>'
        "<script>onload = () => document.body.append(frames[0].document.getElementById('found'))"
        "</script>"
    )
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu"]
    command += ["--allow-file-access-from-files", f"--user-data-dir={tmp_path}/profile"]
    command += ["--virtual-time-budget=20000", "--dump-dom", outer.as_uri()]
    dom = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout
    found = json.loads(re.search(r'<pre id="found">(.*?)</pre>', dom)[1])
    assert found["needed"] <= found["room"] <= width
    assert set(found["requests"]) <= {"data:"}
    scenes = [("paper", "fig3"), ("paper", "fig6"), ("paper", "fig7"), ("lower", "fig3")]
    shapes = [
        pixels(reported.path / "results" / variant / "figures" / f"{scene}.png").shape
        for variant, scene in scenes
    ]
    assert found["images"] == [[wide, high] for high, wide, _ in shapes]
