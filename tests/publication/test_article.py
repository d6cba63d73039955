"""The article: no number of its own, the same bytes each time, and a PDF that tools accept."""

import hashlib
import json
import re
import shutil
import subprocess

import netCDF4
import pytest

from pipeline import config
from pipeline.publication.article import numbers, typesetting
from pipeline.records.sources import ROOT

SOURCE = ROOT / "src" / "pipeline" / "publication" / "article" / "article.typ"
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


def test_the_article_has_the_same_bytes_each_time_and_is_valid(tree):
    pdf = typeset(tree)
    assert pdf == typeset(tree)
    (tree / "article.pdf").write_bytes(pdf)
    if shutil.which("qpdf"):
        checked = subprocess.run(["qpdf", "--check", tree / "article.pdf"], check=False)
        assert checked.returncode == 0
    if shutil.which("pdfinfo"):
        run = ["pdfinfo", tree / "article.pdf"]
        info = subprocess.run(run, check=True, capture_output=True, text=True).stdout
        fields = dict(line.split(":", 1) for line in info.splitlines())
        assert fields["Title"].strip() == data_title(tree)
        assert fields["Tagged"].strip() == "yes"
        assert 8 <= int(fields["Pages"]) <= 14
        assert not {"CreationDate", "ModDate"} & {*fields}


def data_title(tree):
    return json.loads((tree / "numbers.json").read_text())["title"]


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('"rotation number")', '"rotation nunber")', "rotation nunber"),
        ("@greene", "@green", "green"),
        ("#findings(42)", "#findings(4242)", "none"),
        ('#beside("fig2")', '#beside("fig9")', "fig9"),
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
