"""The article: no number of its own, the same bytes each time, and a PDF that tools accept."""

import json
import re
import shutil
import subprocess

import pytest

from pipeline import config
from pipeline.publication.article import numbers, typesetting
from pipeline.records.sources import ROOT

SOURCE = ROOT / "src" / "pipeline" / "publication" / "article" / "article.typ"
# What is no text: comments, formulas, arguments of functions, labels and references.
CODE = re.compile(
    r'//.*|"(?:[^"\\]|\\.)*"|\$[^$]*\$|#\w+\([^()]*\)|[@<][\w-]+|#import.*', re.MULTILINE
)


def typed_numbers(source: str) -> list[str]:
    return re.findall(r"\d+", CODE.sub("", source))


def test_no_number_is_typed_into_the_text():
    assert typed_numbers(SOURCE.read_text()) == []


@pytest.mark.parametrize("text", ["converge to 0.235.", "== Figure 2", "72 statements", "x = 1"])
def test_a_typed_number_is_noticed(text):
    assert typed_numbers(SOURCE.read_text().replace("= Introduction", f"{text}\n= Introduction"))


@pytest.fixture(scope="module")
def data():
    """The numbers of the article, with placeholders for those measured in datasets."""
    used = re.findall(r'#(?:ours|paper)\("(\w+)", "([^"]+)"\)', SOURCE.read_text())
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
        ('#pair("fig2", "fig8")', '#pair("fig2", "fig9")', "fig9"),
    ],
)
def test_a_number_or_reference_that_does_not_exist_is_one_line(tree, old, new, problem):
    text = SOURCE.read_text()
    assert old in text
    (tree / "source" / SOURCE.name).write_text(text.replace(old, new))
    with pytest.raises(typesetting.TypesettingError, match=problem) as raised:
        typeset(tree)
    assert "\n" not in str(raised.value)
