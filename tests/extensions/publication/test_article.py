"""The article: no number of its own, the same bytes each time, and a PDF that tools accept."""

import hashlib
import json
import re
import shutil
import subprocess
from collections import Counter
from html.parser import HTMLParser

import netCDF4
import pytest

from extensions.publication.article import numbers, typesetting
from pipeline import config
from pipeline.records.sources import ROOT

SOURCE = ROOT / "src/extensions/publication/article/article.typ"
WORDS = (
    *("two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"),
    *(r"\w+teen", r"(?:twen|thir|for|fif|six|seven|eigh|nine)ty", "hundred", "thousand", "million"),
)


def typed_numbers(source):
    """Numbers in a source, as digits or in words, that are no names of results or exponents."""
    for allowed in (
        r"(?m)//.*$",
        r'"(?:fig\d|[^"\d]*)"',  # names of figures and quantities, and formulas in words
        r"#(?:findings|rows?)\([\d, ]+\)",  # statements by their numbers
        r"width: \d+%",
        r"@fig\d\b",
    ):
        source = re.sub(allowed, "", source)
    # Formulas have squares and halves.
    source = re.sub(r"\$[^$]*\$", lambda math: re.sub(r"(?:\^| / )2\b", "", math[0]), source)
    return re.findall(rf"(?i)\d+|\b(?:{'|'.join(WORDS)})\b", source)


def test_no_number_is_typed_into_the_text():
    assert typed_numbers(SOURCE.read_text()) == []


@pytest.mark.parametrize(
    "text",
    [
        *("converge to 0.235.", "== Figure 2", "72 statements", "x = 1"),
        *("Seven figures are reproduced.", "It has twenty-one islands."),
        *("an angle of $pi / 3$", "at $x = 0.21$", "$E = x^2 / 2 + 2$"),
        *('#code("0.235")', '#ours("fig2", "orbits", 3)', "#text[7]", "#str(0.235)"),
    ],
)
def test_a_typed_number_is_noticed(text):
    assert typed_numbers(SOURCE.read_text().replace("= Introduction", f"{text}\n= Introduction"))


@pytest.fixture(scope="module")
def data():
    """The numbers of the article, with placeholders for those measured in datasets."""
    used = re.findall(r'\b(?:ours|paper)\("(\w+)", "([^"]+)"\)', SOURCE.read_text())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            numbers,
            "_rows",
            lambda root, checked, scene: {
                quantity: {"paper": "a", "ours": "b"} for name, quantity in used if name == scene
            },
        )
        return json.loads(numbers.numbers_of(ROOT, config.load(ROOT / "config.yaml")))


@pytest.fixture
def tree(data, tmp_path):
    """A folder with the committed pictures, the article's source and its numbers."""
    for folder in ("paper_figures", "more_figures"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    shutil.copytree(SOURCE.parent, tmp_path / "source")
    (tmp_path / "numbers.json").write_text(json.dumps(data))
    return tmp_path


def typeset(tree):
    pytest.importorskip("typst")
    return typesetting.typeset(tree, tree / "numbers.json", tree / "source" / SOURCE.name)


def web_page(tree, **numbers):
    """Return the article's page, with some of its numbers replaced."""
    pytest.importorskip("typst")
    file = tree / "numbers.json"
    file.write_text(json.dumps(json.loads(file.read_text()) | numbers))
    return typesetting.web_page(tree, file, tree / "source" / SOURCE.name).decode()


def test_the_article_has_the_same_bytes_each_time_and_is_valid(tree, data):
    pdf = typeset(tree)
    assert pdf == typeset(tree)
    (tree / "article.pdf").write_bytes(pdf)
    if shutil.which("qpdf"):
        checked = subprocess.run(["qpdf", "--check", tree / "article.pdf"], check=False)
        assert checked.returncode == 0
    if shutil.which("pdfinfo"):
        run = ["pdfinfo", tree / "article.pdf"]
        info = subprocess.run(run, check=True, capture_output=True, text=True).stdout
        fields = {key: words.strip() for key, words in (x.split(":", 1) for x in info.splitlines())}
        assert (fields["Title"], fields["Tagged"]) == (data["title"], "yes")
        assert 8 <= int(fields["Pages"]) <= 24
        assert not {"CreationDate", "ModDate"} & {*fields}


class Links(HTMLParser):
    """The targets of a page's links, its ids, and the sources of what it loads."""

    def __init__(self, text):
        super().__init__()
        self.links, self.ids, self.loaded = [], Counter(), []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.ids.update([attributes["id"]] if "id" in attributes else [])
        if tag == "a" and "href" in attributes:
            self.links.append(attributes["href"])
        if "src" in attributes:
            self.loaded.append(attributes["src"])


def test_the_web_page_has_the_same_bytes_each_time(tree):
    assert web_page(tree) == web_page(tree)


def test_links_of_the_web_page_have_targets_and_it_loads_nothing(tree):
    text = web_page(tree)
    page = Links(text)
    assert set(page.ids.values()) == {1}
    assert {link[1:] for link in page.links if link.startswith("#")} <= {*page.ids}
    # Each number leads to its data, each statement to the row of the ledger.
    assert '<a href="#data-fig7">b</a>' in text
    assert "report.html#claim-21" in page.links
    assert "paper/orbits_fig2.nc" in page.links
    assert page.loaded and all(source.startswith("data:image/") for source in page.loaded)
    assert "<script" not in text and "<math" in text


def test_the_article_is_a_draft_until_citation_cff_is_complete(tree):
    assert "Draft." in web_page(tree, missing=["names of the authors"])
    person = {"name": "Ann Bee", "orcid": "https://orcid.org/0-1"}
    known = {"date": "2026-01-01", "addresses": ["https://doi.org/10.1/x"]}
    whole = web_page(tree, missing=[], authors=[person], **known)
    assert "Draft." not in whole
    for words in (*person.values(), known["date"], *known["addresses"]):
        assert words in whole


def test_each_tick_that_the_paper_prints_is_in_the_comparison(data):
    ours = {scene: data["figures"][scene]["settings"]["axes"] for scene in numbers.PRINTED_TICKS}
    for scene, axes in numbers.PRINTED_TICKS.items():
        for axis, ticks in axes.items():
            assert {*ticks} <= {*ours[scene][axis]["ticks"]}


def test_print_takes_the_vector_file_and_the_web_page_the_smaller_one(data):
    for figure in data["figures"].values():
        vector = (ROOT / figure["file"]).with_suffix(".svg")
        picture = ROOT / figure["web_file"]
        assert (ROOT / figure["file"] == vector) == vector.exists()
        for other in (vector, vector.with_suffix(".png")):
            assert not other.exists() or picture.stat().st_size <= other.stat().st_size


def test_a_box_has_whole_sentences_with_mathematics(tree):
    text = web_page(tree)
    (box,) = re.findall(r'<div class="finding">[^.]*"report.html#claim-21".*?</div>', text)
    plain = re.sub(r"<[^>]*>", "", box)
    assert re.search(r"Here: The elliptic fixed point is at x = 0\.\d+, and there is no", plain)
    assert "Accuracy: 10−12." in plain and "<sup>−12</sup>" in box


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('"rotation number")', '"rotation nunber")', "rotation nunber"),
        ("@greene", "@green", "green"),
        ("#findings(42)", "#findings(4242)", "none"),
        ('#beside("fig2")', '#beside("fig9")', "fig9"),
        ('#theorem("entropy")', '#theorem("no-theorem")', "none"),
    ],
)
def test_a_number_or_reference_that_does_not_exist_is_one_line(tree, old, new, problem):
    text = SOURCE.read_text()
    assert old in text
    (tree / "source" / SOURCE.name).write_text(text.replace(old, new))
    with pytest.raises(typesetting.TypesettingError, match=problem) as raised:
        typeset(tree)
    assert "\n" not in str(raised.value)


def test_a_result_that_was_edited_by_hand_is_named_and_no_article_is_set(moved):
    """Its record fits; only the manifest tells."""
    file = "results/paper/motion_fig3.nc"
    path = moved.path / file
    with netCDF4.Dataset(path, "r+") as data:
        data["position"][0] += 1e-9
    record = path.parent / "provenance" / f"{path.name}.json"
    content = json.loads(record.read_text())
    content["output"]["sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    record.write_text(json.dumps(content))
    result = moved.run("article")
    assert result.returncode == 1
    assert re.fullmatch(rf"reproduce: article: [^\n]*{re.escape(file)}[^\n]*\n", result.stdout)
    assert not (moved.path / "results" / "article.pdf").exists()
