"""The report and docs/figures.md: every figure, its caption and what was measured in it."""

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
from project import ROOT, Tree, fresh_tree, of_scenes
from runs import VARIANTS

from pipeline import config
from pipeline.checks import claims, quantities
from pipeline.checks.claims.schema import CORRECTED, FALSE
from pipeline.checks.report import captions, figures_page, page
from pipeline.config import paths
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.study import CHARTS
from pipeline.explorer.data import collect
from pipeline.records.artifacts import load
from pipeline.records.pictures import pixels
from pipeline.records.record import record_path, refusal_path

PAGE = "results/report/report.html"
CHROMIUM = shutil.which("chromium")
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
def reported(shared, variants):
    """A read-only copy with three small scenes, two of them also in a variant, and their report."""

    def make(folder):
        tree = fresh_tree(folder, of_scenes("fig3", "fig6", "fig7", variants=VARIANTS), variants)
        shutil.copy(ROOT / "CLAIMS.json", folder)
        (folder / "said").write_text(tree.succeed("report"))

    return Tree(shared("reported in a folder with spaces", make))


@pytest.fixture(scope="module")
def text(reported):
    return (reported.path / PAGE).read_text(encoding="utf-8")


class Outline(HTMLParser):
    """The tags of a page with their attributes; each tag must be closed."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.open = [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "link", "img", "wbr", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, self.getpos()

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def rendered(tree):
    html = page.render(tree.path, config.load(tree.config))
    Outline(html)
    return html


def test_every_figure_is_in_the_page_byte_for_byte(reported, text):
    results = reported.path / "results"
    figures = [results / f"paper/figures/{name}.png" for name in ("fig3", "fig6", "fig7")]
    for path in (*figures, results / "low/figures/fig3.png"):
        assert text.count(base64.b64encode(path.read_bytes()).decode()) == 1
    assert (reported.path / "said").read_text().splitlines()[-1].startswith(f"{PAGE}  ")


def test_the_page_needs_no_network_and_its_links_have_targets(reported, text):
    outline = Outline(text)
    policy = [a["content"] for a in outline.all("meta") if "http-equiv" in a]
    (script,) = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert policy == [
        "default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
        f"script-src 'sha256-{digest}'"
    ]
    assert [a["href"] for a in outline.all("link")] == ["data:,"]
    assert outline.all("script") == [{}] and "@import" not in text and "url(" not in text
    for image in outline.all("img"):
        assert image["src"].startswith("data:image/png;base64,")
    whole = [image for image in outline.all("img") if image["alt"]]
    assert all(len(image["alt"]) > 40 and image["width"] and image["height"] for image in whole)
    assert len(outline.all("img")) == len(whole) + 3  # small copies of fig3, fig6 and fig7
    ids = Counter(a["id"] for _, a in outline.tags if "id" in a)
    assert set(ids.values()) == {1}
    links = [a["href"] for a in outline.all("a")]
    assert links[0] == "#main"  # the skip link comes first
    explorer = [link for link in links if link.startswith("../explorer.html")]
    opened = {link.partition("#")[2] for link in explorer} - {""}
    scenes = {*collect(config.load(reported.config), reported.path)["scenes"]}
    assert {"fig3", "fig6", "fig7", "low/fig3"} <= opened <= scenes
    assert "../explorer.html" in explorer
    files = {link for link in links if link.startswith("../../")}
    assert all((reported.path / link[6:]).is_file() for link in files)
    assert "../../results/paper/periodic_fig3.nc" in files
    assert {*links} - {*explorer} - files <= {f"#{name}" for name in ids}
    levels = [int(tag[1]) for tag, _ in outline.tags if re.fullmatch(r"h\d", tag)]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))
    assert outline.all("html") == [{"lang": "en"}]


def test_in_the_site_the_links_are_to_its_own_files(reported):
    html = page.render(reported.path, config.load(reported.config), in_site=True)
    links = {a["href"].partition("#")[0] for a in Outline(html).all("a")} - {""}
    data = {f"paper/{name}.nc" for name in ("periodic_fig3", "motion_fig3", "lyapunov_fig7")}
    assert {"explorer.html", "article.html", "article.pdf"} | data <= links
    assert all(link.startswith("paper/") or "/" not in link for link in links)


def test_the_first_screen_counts_the_verdicts(text):
    rows = claims.read_json((ROOT / "CLAIMS.json").read_text(encoding="utf-8"))
    first, _, _ = text.partition("<main")
    for verdict, count in Counter(row.verdict for row in rows).items():
        assert f'data-pick="{verdict}">{verdict}: {count}<' in first
    assert len(re.findall(r'<tr role="row" id="claim-\d+" data-verdict="holds">', text)) == sum(
        row.verdict == "holds" for row in rows
    )


def test_each_figure_has_its_caption_and_numbers(reported, text):
    scenes = config.load(reported.config)["scenes"]
    for scene, block in scenes.items():
        assert captions.caption_of(scene, block).shows in text
    assert "<td>approximately 0.235</td><td>0." in text
    assert "<td>between 0.0925 and 0.0932</td><td>0.09" in text
    assert "<td>0.21 to 0.2116</td><td>0.21 to 0.2116</td>" in text
    assert "orbit: elliptic, period 1 (at the paper" in text  # of the variant


def test_corrections_first_and_the_whole_table(text):
    rows = claims.read_json((ROOT / "CLAIMS.json").read_text(encoding="utf-8"))
    wrong = [row for row in rows if row.verdict in (FALSE, CORRECTED)]
    assert len(rows) == len(claims.CLAIMS) and 0 < len(wrong) < len(claims.CLAIMS)
    above, _, whole = text.partition('id="claims"')
    assert {f'href="#claim-{row.number}"' for row in wrong} == set(
        re.findall(r'href="#claim-\d+"', above)
    )
    assert len(re.findall(r'<tr role="row" id="claim-\d+" ', whole)) == len(claims.CLAIMS)


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
    (tree.path / "CLAIMS.json").write_text("nothing <b> of the kind")
    shutil.rmtree(tree.path / "results" / "low")
    with open(tree.path / "results" / "paper" / "lyapunov_fig7.nc", "r+b") as file:
        file.truncate(1000)
    fig6 = "results/paper/figures/fig6.png"
    (tree.path / fig6).unlink()
    refusal = json.loads((tree.path / record_path(fig6)).read_text())
    refusal["output"] = {"sha256": None, "refused": "no hyperbolic orbit"}
    (tree.path / refusal_path(fig6)).write_text(json.dumps(refusal))
    text = rendered(tree)
    assert "no readable <code>CLAIMS.json</code>" in text
    assert "did not make: low" in text and '<h2 id="variants"' not in text
    assert "<p>No picture: stale: changed after it was made; made from another results/" in text
    assert "<td>approximately 0.235" not in text
    assert "<p>No picture: cannot exist: no hyperbolic orbit.</p>" in text
    assert 'alt="Figure 6' not in text


def article(text, name):
    """Return the article of a committed picture in a page, without its image."""
    text = re.sub('base64,[^"]*', "base64,", text)
    found = re.search(f'<article id="more_figures-{name}[.]png".*?</article>', text, re.DOTALL)
    return found and found.group()


@pytest.mark.slow
def test_committed_pictures_are_shown_if_the_tree_made_none(reported, tmp_path):
    tree = reported.copy(tmp_path / "committed")
    pictures = sorted((ROOT / "more_figures").glob("*/*.png"))
    shutil.copy(ROOT / "tests" / "scenes.yaml", tree.config)
    assert article(rendered(tree), "claims-flux") is None
    shutil.copytree(ROOT / "more_figures", tree.path / "more_figures", dirs_exist_ok=True)
    for folder in (tree.path / "more_figures").iterdir():  # the pictures may be under work
        files = sorted(folder.glob("*.png"))
        sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in files]
        (folder / "SHA256SUMS").write_text("".join(sums))
    text = re.sub(r"<wbr>|</?a\b[^>]*>", "", rendered(tree))
    for path in pictures:
        assert text.count(base64.b64encode(path.read_bytes()).decode()) == 1, path
        assert f"{path.parent.name}/{path.name}: the committed one (" in text
    assert "no hash of measurements is kept" in article(text, "study-seconds_grazing")
    # Without the manifest, the values in the caption may not be those of the picture.
    (tree.path / "more_figures" / "claims" / "MANIFEST.json").unlink()
    flux = article(rendered(tree), "claims-flux")
    assert "other values than config.yaml" in flux and "hyperbolic orbit of period" not in flux
    with open(tree.path / "more_figures" / "claims" / "flux.png", "ab") as file:
        file.write(b"x")
    flux = article(rendered(tree), "claims-flux")
    assert "<p>No picture: more_figures/claims/flux.png is not the" in flux and "<img" not in flux


def test_whole_numbers_have_commas(text):
    markup = '<style>.*?</style>|base64,[^"]*|<[^>]*>'
    words = re.sub(markup, " ", text, flags=re.DOTALL).partition("what made each result")[0]
    assert not re.findall(r"(?<![\d.,])\d{5,}(?![\d.,])", words)


def test_every_picture_has_a_caption():
    assert set(captions.CAPTIONS["kinds"]) == set(KINDS)
    assert set(captions.CAPTIONS["charts"]) == set(CHARTS)


def test_the_page_of_figures_is_current_and_complete():
    text = (ROOT / "docs" / "figures.md").read_text(encoding="utf-8")
    assert text == figures_page.page(), "renew it: python -m pipeline.checks.report.figures_page"
    pictures = [*ROOT.glob("paper_figures/*.png"), *ROOT.glob("more_figures/*/*.png")]
    links = Counter(re.findall(r"\]\(\.\./(\S+)\)", text))
    assert links == Counter(str(path.relative_to(ROOT)) for path in pictures)
    assert max(map(len, text.splitlines())) <= 100
    assert not re.findall(r"^[-+*>=] ", text, re.MULTILINE)  # no line of a caption is a list


@pytest.fixture(scope="module")
def scenes(finished):
    """Scene -> its block and its datasets."""
    blocks = config.load(finished.config)["scenes"]
    files = paths.artifact_paths({config.PAPER: blocks})
    return {
        scene: (block, {s: load(finished.path / files["paper", scene, s]) for s in stages})
        for scene, block in blocks.items()
        for stages in [paths.stages(block)]
    }


def test_quantities_are_measured_in_the_data_and_not_read_from_the_config(scenes):
    for scene, (block, data) in scenes.items():
        kind = KINDS[block["picture"]]
        values = kind.numbers(block, **data)
        assert kind.headline in values
        assert set(quantities.PAPER_NUMBERS[scene]) <= set(values)
        other = block | {"energy": 0.5, "impacts": 3, "starts": [0.1], "duration": 1.0}
        other |= {"window": {"x": [0, 1], "xdot": [0, 1]}, "length": 9, "period": 99}
        assert kind.numbers(other, **data) == values


def test_other_data_other_numbers(scenes):
    def measured(scene, **changes):
        block, data = scenes[scene]
        other = data | {stage: change(data[stage]) for stage, change in changes.items()}
        return KINDS[block["picture"]].numbers(block, **other)

    shifted = measured("fig6", manifolds=lambda d: d.assign_attrs(point_x=0.3, window_x=[0.2, 0.4]))
    assert shifted["x of the point"] == "0.3000000" and shifted["window, x"] == "0.2 to 0.4"
    faster = measured("fig2", orbits=lambda d: d.assign(xdot=d["xdot"] * 1.1))
    assert faster["energy"] != measured("fig2")["energy"] == "0.01"
    larger = measured("fig7", lyapunov=lambda d: d.assign(exponent=d["exponent"] + 1.0))
    assert all(float(value) > 1.0 for value in larger["largest exponent"].split(", "))


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
@pytest.mark.parametrize("width", [1280, 390])
def test_in_a_browser(reported, text, tmp_path, width):
    """The page is shown in a frame, as chromium's windows are no narrower than 500 pixels."""
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
    results = reported.path / "results"
    files = [results / f"paper/figures/{name}.png" for name in ("fig3", "fig6", "fig7")]
    shapes = [pixels(file).shape for file in (*files, *sorted(results.glob("low/figures/*.png")))]
    assert found["images"][3:] == [[wide, high] for high, wide, _ in shapes]


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
def test_the_table_of_statements_is_filtered_and_a_link_shows_a_hidden_one(text, tmp_path):
    """The numbers of rows in sight: all, proved, with a word, and after a link to another one."""
    look = """
    const seen = [], form = document.getElementById("filter");
    const look = () => {
      form.dispatchEvent(new Event("input", {bubbles: true}));
      const rows = [...document.querySelectorAll("tr[data-verdict]")];
      seen.push(rows.filter((row) => row.getClientRects().length).length);
    };
    look();
    form.verdict.value = "proved"; look();
    form.verdict.value = ""; form.words.value = "diffeomorphism smooth"; look();
    addEventListener("hashchange", () => { look(); document.title = seen.join(" "); });
    location.hash = "claim-1";
    """
    plain = re.sub(r"<meta http-equiv[^>]*>", "", text)
    (tmp_path / "page.html").write_text(plain.replace("</body>", f"<script>{{{look}}}</script>"))
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu"]
    command += [f"--user-data-dir={tmp_path}/profile", "--virtual-time-budget=20000", "--dump-dom"]
    command.append((tmp_path / "page.html").as_uri())
    dom = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout
    rows = claims.read_json((ROOT / "CLAIMS.json").read_text(encoding="utf-8"))
    proved = sum(row.verdict == "proved" for row in rows)
    whole, shown, found, after = map(int, re.search(r"<title>([\d ]+)<", dom)[1].split())
    assert (whole, shown, after) == (len(rows), proved, len(rows))
    assert 1 <= found < 10
