"""The report and docs/figures.md: every figure, its caption and what was measured in it."""

import base64
import hashlib
import io
import json
import re
import shutil
from collections import Counter
from html import unescape

import numpy as np
import pytest
from PIL import Image
from project import ROOT, SHIPPED
from report_pages import (
    CHROMIUM,
    PAGE,
    Outline,
    article,
    in_browser,
    rendered,
    with_script,
)

from paper.numbers import PAPER_NUMBERS
from pipeline import config
from pipeline.checks import captions, quantities
from pipeline.config import PUBLISHED
from pipeline.config.schema.kinds import KINDS
from pipeline.records.artifacts import load
from pipeline.records.pictures import pixels
from pipeline.records.record import record_path, refusal_path

# Report the width of the page and the sizes of its pictures in a browser.
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


@pytest.fixture(scope="module")
def text(reported):
    return (reported.path / PAGE).read_text(encoding="utf-8")


def decoded(text):
    """Return the whole pictures of a page, arrays of shape (height, width, 3), in their order."""
    images = [image for image in Outline(text).all("img") if image["alt"]]
    data = [base64.b64decode(image["src"].partition("base64,")[2]) for image in images]
    return [np.asarray(Image.open(io.BytesIO(each)).convert("RGB")).astype(int) for each in data]


def is_shown(path, images):
    """Whether one of some images is a file's, pixel by pixel, in the shades of the page."""
    drawn = pixels(path).astype(int)
    same = [each for each in images if each.shape == drawn.shape]
    return any(abs(each - drawn).max() <= 8 for each in same)


def test_every_figure_is_in_the_page_pixel_by_pixel(reported, text):
    results = reported.path / "results"
    figures = [results / f"paper/figures/{name}.png" for name in ("fig3", "fig6", "fig7")]
    for path in (*figures, results / "low/figures/fig3.png"):
        assert is_shown(path, decoded(text))
    assert all((image[0, 0] == 255).all() for image in decoded(text))  # white stays white
    whole = sum(path.stat().st_size for path in figures)
    assert len(text) < whole + 50_000
    assert (reported.path / "said").read_text().splitlines()[-1].startswith(f"{PAGE}  ")


def test_the_page_needs_no_network_and_its_links_have_targets(reported, text):
    outline = Outline(text)
    policy = [a["content"] for a in outline.all("meta") if "http-equiv" in a]
    scripts = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    digests = [base64.b64encode(hashlib.sha256(s.encode()).digest()).decode() for s in scripts]
    allowed = " ".join(f"'sha256-{digest}'" for digest in digests) or "'none'"
    assert policy == [
        f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {allowed}"
    ]
    assert [a["href"] for a in outline.all("link")] == ["data:,"]
    assert outline.all("script") == [{}] * len(scripts)
    assert "@import" not in text and "url(" not in text
    for image in outline.all("img"):
        assert image["src"].startswith("data:image/webp;base64,")
    whole = [image for image in outline.all("img") if image["alt"]]
    assert all(len(image["alt"]) > 40 and image["width"] and image["height"] for image in whole)
    assert len(outline.all("img")) == len(whole) + 3  # small copies of fig3, fig6 and fig7
    ids = Counter(a["id"] for _, a in outline.tags if "id" in a)
    assert set(ids.values()) == {1}
    links = [a["href"] for a in outline.all("a")]
    assert links[0] == "#main"  # the skip link comes first
    within = {link for link in links if link.startswith("#")}
    assert within <= {f"#{name}" for name in ids}
    files = {link.partition("#")[0] for link in links} - {""}
    assert all((reported.path / "results" / "report" / file).is_file() for file in files)
    assert "../../results/paper/periodic_fig3.nc" in files
    assert outline.all("html") == [{"lang": "en"}]


def test_in_the_site_the_links_are_to_its_own_files(reported):
    html = rendered(reported, beside={"Article": "article.html"})
    links = {a["href"].partition("#")[0] for a in Outline(html).all("a")} - {""}
    data = {f"paper/{name}.nc" for name in ("periodic_fig3", "motion_fig3", "lyapunov_fig7")}
    assert {"article.html"} | data <= links
    assert all(link.startswith("paper/") or "/" not in link for link in links)


def test_each_figure_has_its_caption_and_numbers(reported, text):
    checked = config.load(reported.config)
    for scene, block in checked.scenes.items():
        known = None
        if scene in ("fig3", "fig6", "fig7"):  # those that were made
            known = quantities.measured(
                reported.path, checked, config.MAIN, scene, quantities.facts
            )
            assert captions.caption_of(scene, block.as_mapping(), known).see in unescape(text)
    assert "<td>approximately 0.235</td><td>0." in text
    assert "<td>between 0.0925 and 0.0932</td><td>0.09" in text
    assert "<td>0.21 to 0.2116</td><td>0.21 to 0.2116</td>" in text
    assert "orbit: elliptic, period 1 (at the paper" in text  # of the variant


def test_the_page_depends_on_results_alone_but_for_provenance(reported, text, tmp_path):
    record = reported.path / "results" / "paper" / "provenance" / "fig3.png.json"
    assert json.loads(record.read_text())["output"]["sha256"] in text
    plain = text.replace("<wbr>", "")
    made = re.findall(r'>(results/[^<]+)</a></th>.*data-label="seconds">([^<]*)<', plain)
    assert len(made) == 8 + 5 and all(re.fullmatch(r"\d+\.\d", seconds) for _, seconds in made)
    assert rendered(reported) == text
    copy = reported.copy(tmp_path / "elsewhere")
    for path in copy.path.glob("results/*/provenance/*.json"):
        path.write_text(json.dumps(json.loads(path.read_text()) | {"seconds": "many"}))
    other = rendered(copy)
    assert "not known" in other
    timed = re.compile(r'data-label="seconds">[^<]*<')
    assert timed.sub("", other) == timed.sub("", text)


def test_what_is_missing_or_damaged_is_not_shown(reported, tmp_path):
    tree = reported.copy(tmp_path / "poor")
    shutil.rmtree(tree.path / "results" / "low")
    with open(tree.path / "results" / "paper" / "lyapunov_fig7.nc", "r+b") as file:
        file.truncate(1000)
    fig6 = "results/paper/figures/fig6.png"
    (tree.path / fig6).unlink()
    refusal = json.loads((tree.path / record_path(fig6)).read_text())
    refusal["output"] = {"sha256": None, "refused": "no hyperbolic orbit"}
    (tree.path / refusal_path(fig6)).write_text(json.dumps(refusal))
    text = rendered(tree)
    assert "Not computed yet: low" in text and '<h2 id="variants"' not in text
    assert "<p>No picture: stale: changed after it was made; made from another results/" in text
    assert "<td>approximately 0.235" not in text
    assert "<p>No picture: cannot exist: no hyperbolic orbit.</p>" in text
    assert 'alt="Figure 6' not in text


@pytest.mark.slow
def test_committed_pictures_are_shown_if_the_tree_made_none(reported, tmp_path):
    tree = reported.copy(tmp_path / "committed")
    folders = [folder for name, folder in PUBLISHED.items() if name != config.MAIN]
    pictures = [file for folder in folders for file in sorted((ROOT / folder).glob("*.png"))]
    shutil.copy(SHIPPED, tree.config)
    assert article(rendered(tree), "study-edges") is None
    shutil.copytree(ROOT / "more_figures", tree.path / "more_figures", dirs_exist_ok=True)
    for folder in (tree.path / "more_figures").iterdir():  # the pictures may be under work
        files = sorted(folder.glob("*.png"))
        sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files]
        (folder / "SHA256SUMS").write_text("".join(sums))
    text = re.sub(r"<wbr>|</?a\b[^>]*>", "", rendered(tree))
    images = decoded(text)
    for path in pictures:
        assert is_shown(path, images), path
        assert f"{path.parent.name}/{path.name}: published file" in text
    assert text.count("were not computed in this copy") == 1
    assert "published file, whose hash is not kept" in article(text, "study-seconds_grazing")
    with open(tree.path / "more_figures" / "study" / "edges.png", "ab") as file:
        file.write(b"x")
    edges = article(rendered(tree), "study-edges")
    assert "<p>No picture: more_figures/study/edges.png is neither the" in edges
    assert "<img" not in edges


@pytest.fixture(scope="module")
def scenes(finished):
    """Scene -> its block and its datasets."""
    checked = config.load(finished.config)
    files = {scene: checked.data_of("paper", scene).items() for scene in checked.scenes}
    return {
        scene: (block.as_mapping(), {s: load(finished.path / f) for s, f in files[scene]})
        for scene, block in checked.scenes.items()
    }


def test_quantities_are_measured_in_the_data_and_not_read_from_the_config(scenes):
    for scene, (block, data) in scenes.items():
        kind = KINDS[block["picture"]]
        values = quantities.reported(block, data)
        assert kind.headline in values
        assert set(PAPER_NUMBERS[scene]) <= set(values)
        other = block | {"energy": 0.5, "impacts": 3, "starts": [0.1], "duration": 1.0}
        other |= {"window": {"x": [0, 1], "xdot": [0, 1]}, "length": 9, "period": 99}
        assert quantities.reported(other, data) == values


def test_other_data_give_other_numbers(scenes):
    def measured(scene, **changes):
        block, data = scenes[scene]
        other = data | {stage: change(data[stage]) for stage, change in changes.items()}
        return quantities.reported(block, other)

    shifted = measured("fig6", manifolds=lambda d: d.assign_attrs(point_x=0.3, window_x=[0.2, 0.4]))
    assert shifted["x of the point"] == "0.3000000" and shifted["window, x"] == "0.2 to 0.4"
    faster = measured("fig2", orbits=lambda d: d.assign(xdot=d["xdot"] * 1.1))
    assert faster["energy"] != measured("fig2")["energy"] == "0.01"
    larger = measured("fig7", lyapunov=lambda d: d.assign(exponent=d["exponent"] + 1.0))
    assert all(float(value) > 1.0 for value in larger["largest exponent"].split(", "))


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
def test_a_phone_shows_the_whole_page_and_requests_nothing(reported, text, tmp_path):
    """The page is shown in a frame, as chromium's windows are no narrower than 500 pixels."""
    width, outer = 390, tmp_path / "outer.html"
    (tmp_path / "page.html").write_text(with_script(text, LOOK))
    outer.write_text(
        f'<iframe src="page.html" width="{width}" height="900" style="border:0"></iframe>'
        "<script>onload = () => document.body.append(frames[0].document.getElementById('found'))"
        "</script>"
    )
    dom = in_browser(outer)
    found = json.loads(re.search(r'<pre id="found">(.*?)</pre>', dom)[1])
    assert found["needed"] <= found["room"] <= width
    assert set(found["requests"]) <= {"data:"}
    results = reported.path / "results"
    files = [results / f"paper/figures/{name}.png" for name in ("fig3", "fig6", "fig7")]
    shapes = [pixels(file).shape for file in (*files, *sorted(results.glob("low/figures/*.png")))]
    assert found["images"][3:] == [[wide, high] for high, wide, _ in shapes]
