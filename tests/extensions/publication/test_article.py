"""The article: no number of its own, the same bytes each time, and a PDF that tools accept."""

import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import pytest

from extensions.publication.article import numbers, typesetting
from helpers.parts.outline import Outline
from helpers.project import run
from helpers.slowly import slowly
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
        r'"(?:(?:publication/)?fig\d|[^"\d]*)"',  # names and formulas in words
        r"#(?:findings|rows?)\([\d, ]+\)",  # statements by their numbers
        r"width: \d+%",
        r"@(?:publication-)?fig\d\b",
    ):
        source = re.sub(allowed, "", source)
    # Formulas have squares and halves.
    source = re.sub(r"\$[^$]*\$", lambda math: re.sub(r"(?:\^| / )2\b", "", math[0]), source)
    return re.findall(rf"(?i)\d+|\b(?:{'|'.join(WORDS)})\b", source)


def test_no_number_is_typed_into_the_text():
    assert typed_numbers(SOURCE.read_text()) == []


@pytest.fixture(scope="module")
def data():
    """The numbers of the article, with placeholders for those measured in datasets."""
    used = re.findall(r'\b(?:ours|paper)\("(\w+)", "([^"]+)"\)', SOURCE.read_text())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            numbers,
            "measured",
            lambda *given: {quantity: "b" for name, quantity in used if name == given[-1]},
        )
        patch.setattr(numbers, "printed", lambda *_: "a")
        return json.loads(numbers.numbers_of(ROOT, config.load(ROOT / "config.yaml")))


@pytest.fixture(scope="module")
def tree(data, tmp_path_factory):
    """A folder with the committed pictures."""
    folder = tmp_path_factory.mktemp("article")
    for name in ("paper_figures", "more_figures"):
        (folder / name).symlink_to(ROOT / name)
    return folder


@pytest.fixture(scope="module")
def compiled(tree, data):
    """A function that makes a document from the article's source, edited, and its numbers."""
    pytest.importorskip("typst")

    def compile_with(how=typesetting.web_page, old="", new="", **replaced):
        folder = Path(tempfile.mkdtemp(dir=tree))
        shutil.copytree(SOURCE.parent, folder, dirs_exist_ok=True)
        source = folder / SOURCE.name
        assert old in source.read_text()
        source.write_text(source.read_text().replace(old, new))
        return how(tree, json.dumps(data | replaced), source)

    return compile_with


@pytest.fixture(scope="module")
def page(compiled):
    """The web page without its pictures."""
    return re.sub('base64,[^"]*', "", compiled().decode())


@pytest.mark.parametrize("how", [typesetting.web_page, *slowly(typesetting.typeset)])
def test_the_article_has_the_same_bytes_each_time(compiled, how):
    assert compiled(how) == compiled(how)


def test_the_article_is_a_valid_pdf(compiled, data, tmp_path):
    file = tmp_path / "article.pdf"
    file.write_bytes(compiled(typesetting.typeset))
    if shutil.which("qpdf"):
        assert subprocess.run(["qpdf", "--check", file], check=False).returncode == 0
    if shutil.which("pdfinfo"):
        info = run("pdfinfo", file).stdout
        fields = {key: words.strip() for key, words in (x.split(":", 1) for x in info.splitlines())}
        assert (fields["Title"], fields["Tagged"]) == (data["title"], "yes")
        assert 8 <= int(fields["Pages"]) <= 24 and not {"CreationDate", "ModDate"} & {*fields}


def test_the_web_page_is_a_draft_whose_links_have_targets_and_that_loads_nothing(compiled):
    text = compiled(missing=["names of the authors"]).decode()
    assert "Draft." in text
    page = Outline(text.replace("<br>", ""))
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    links = [attributes["href"] for attributes in page.all("a") if "href" in attributes]
    loaded = [attributes["src"] for _, attributes in page.tags if "src" in attributes]
    assert len(set(ids)) == len(ids)
    assert {link[1:] for link in links if link.startswith("#")} <= {*ids}
    # Each number leads to its data, each statement to the row of the ledger.
    assert '<a href="paper/lyapunov_fig7.nc">b</a>' in text
    assert {"CLAIMS.html#statement-21", "paper/orbits_fig2.nc"} <= {*links}
    assert loaded and all(source.startswith("data:image/") for source in loaded)
    assert "<script" not in text and "<math" in text
    # A box has whole sentences with mathematics.
    (box,) = re.findall(r'<div class="finding">[^.]*"CLAIMS.html#statement-21".*?</div>', text)
    plain = re.sub(r"<[^>]*>", "", box)
    assert re.search(r"Here: The elliptic fixed point is at x = 0\.\d+, and there is no", plain)
    assert "Accuracy: 10−12." in plain and "<sup>−12</sup>" in box


def test_each_formula_is_valid_and_is_described(page):
    """A MathML token has text alone, a mover has two children, and alttext says what is meant."""
    formulas = re.findall(r"<math\b.*?</math>", page, re.S)
    assert len(formulas) > 50
    tokens, boxes = {"mi", "mo", "mn", "mtext"}, {"math", "mrow", "msup", "msub", "mfrac", "mover"}
    for formula in map(ElementTree.fromstring, formulas):
        assert re.search(r"\w", formula.get("alttext"))
        assert formula.get("aria-label") == formula.get("alttext")
        for element in formula.iter():
            assert element.tag in tokens | boxes | {"mspace"}, formula.get("alttext")
            assert len(element) == 2 or element.tag not in ("mover", "msup", "msub", "mfrac")
            assert bool(element.text) == (element.tag in tokens)
            assert not (element.tag in tokens and len(element))


@pytest.mark.parametrize(("old", "new", "problem"), [
    ('"rotation number")', '"rotation nunber")', "rotation nunber"),
    ("@greene", "@green", "green"),
    ("#findings(42)", "#findings(4242)", "none"),
    ('"families/energy"', '"energy"', "energy"),  # a bare name
])  # fmt: skip
def test_a_number_or_reference_that_does_not_exist_is_one_line(compiled, old, new, problem):
    with pytest.raises(ValueError, match=rf"^[^\n]*{problem}[^\n]*$"):
        compiled(old=old, new=new)


def test_a_figure_that_is_not_published_is_named(compiled, data):
    figures = {name: figure for name, figure in data["figures"].items() if name != "fig4"}
    with pytest.raises(ValueError, match="the article needs fig4, which is not published"):
        compiled(figures=figures)


def test_the_article_is_a_draft_until_citation_cff_is_complete(compiled):
    facts = numbers.read_citation()
    assert {"doi, of the archived software", "ORCIDs of the authors"} <= {*numbers.missing(facts)}
    orcid = "https://orcid.org/0-1"
    facts |= {
        "authors": [{"given-names": "Ann", "family-names": "Bee", "orcid": orcid}], "doi": "10.1/x",
        "repository-code": "https://example.org/x", "date-released": "2026-01-01",
    }  # fmt: skip
    text = compiled(**numbers._of_citation(facts)).decode()
    assert "Draft." not in text
    for words in ("Ann Bee", orcid, "2026-01-01", "https://doi.org/10.1/x", "example.org/x"):
        assert words in text
