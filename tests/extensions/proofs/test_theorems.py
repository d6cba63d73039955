"""The theorems are proved, and their pages have the numbers of the checkers."""

import re
import tomllib
from importlib import import_module
from inspect import signature

import numpy as np
import pytest
from flint import arb, ctx

from extensions.proofs import THEOREMS, search_certificate
from extensions.proofs.checkers.fixed_point import energy_at, slope_at, trace_at
from extensions.proofs.command import CERTIFICATES
from extensions.proofs.search import graph
from extensions.proofs.theorems.statements import theorem_verdict
from helpers.parts.certificates import ONE_OF_EACH
from helpers.project import ROOT
from helpers.slowly import slowly
from pipeline import config
from pseudorigid.dynamics import fixed_point

HORSESHOES = ["horseshoe-outer", "horseshoe-inner"]
CURVES = [n for n in THEOREMS if n.startswith("curve-")]
DEAR = [*CURVES, "entropy", "horseshoe-inner", "horseshoe-smooth", "twist-one-zero"]  # to check
QUICK = [n for n in THEOREMS if n not in DEAR]
DEAR_SEARCHES = ["horseshoe-outer", "no-circle", "twist-one-zero", "entropy-lower"]
SEARCHES = [n for n in ONE_OF_EACH if n not in (*DEAR, *DEAR_SEARCHES)]


@pytest.fixture(scope="module")
def results(pickled):
    """The results of the theorems that are checked quickly."""
    return pickled("theorems", lambda: {name: THEOREMS[name].check() for name in QUICK})


def middle(digits):
    """The midpoint of an enclosure as text."""
    return digits.strip("[").split()[0]


def test_every_theorem_is_proved_with_positive_margins_in_a_line(results):
    for name, result in results.items():
        line = result.line()
        assert result.verdict == "proved", line
        assert min(result.margins.values()) > 0 and "\n" not in line
        assert line.startswith(f"{name}.toml: ") and line.endswith("; proved")
    assert THEOREMS["fixed-point"].check("nonsense").line().endswith("; not proved")


@pytest.mark.parametrize(
    "name", [*SEARCHES, "six-inverse", "ten-elliptic", *slowly(*DEAR_SEARCHES)]
)
def test_a_new_search_gives_a_certificate_that_holds(name):
    text = search_certificate(name)
    assert THEOREMS[name].check(text).verdict == "proved"
    if name == "horseshoe-outer":
        assert text == THEOREMS[name].text()


@pytest.mark.parametrize("name", THEOREMS)
def test_every_theorem_has_a_search_for_its_certificate(name, monkeypatch):
    checker = THEOREMS[name].checker
    module = import_module(checker.__module__.replace(".checkers.", ".search."))
    asked = []

    def propose(theorem, **hints):
        asked.append((theorem, hints))
        return "text"

    propose_name = checker.__name__.replace("check", "propose")
    signature(getattr(module, propose_name)).bind(THEOREMS[name], **THEOREMS[name].hints)
    monkeypatch.setattr(module, propose_name, propose)
    assert search_certificate(name) == "text"
    assert asked == [(THEOREMS[name], THEOREMS[name].hints)]


def test_the_sets_of_a_graph_are_those_that_its_search_places_at_saddles():
    theorem = THEOREMS["entropy-lower"]
    double_map = graph.DoubleMap(theorem.bounds["surface"])
    placed = graph._sets(double_map, theorem.hints["periods"], theorem.hints["size"])
    rows = [np.concatenate(each) for each in placed]
    for row in tomllib.loads(theorem.text())["sets"]:
        assert any(np.allclose(row, other, rtol=1e-7, atol=0.0) for other in rows)


def imports(folder):
    """The text of the imports of each module of a folder of the proofs."""
    files = sorted((ROOT / "src/extensions/proofs" / folder).glob("*.py"))
    assert files
    line = re.compile(r"^ *(?:from|import) .*$", re.M)
    return {file.stem: "\n".join(line.findall(file.read_text())) for file in files}


def test_no_checker_imports_a_search():
    for folder in ("checkers", "enclosure"):
        assert not any(re.search(r"\bsearch\b", text) for text in imports(folder).values())


# ---- the page


FOLDER = ROOT / "src/extensions/proofs"
PAGE = "".join(file.read_text(encoding="utf-8") for file in sorted(FOLDER.glob("theory/*.md")))
README = (ROOT / "README.md").read_text(encoding="utf-8")
CELLS = {  # of each row about a theorem in a table of the page
    name: row.split(" | ") for name, row in re.findall(r"^\| `(.*?)` \| (.*) \|$", PAGE, re.M)
    if name in THEOREMS
}  # fmt: skip


SHOWN = [n for n in CELLS if n in QUICK] + slowly(*(n for n in DEAR if n in CELLS))


@pytest.mark.parametrize("name", SHOWN)
def test_the_tables_of_the_page_have_the_checkers_numbers(name, results):
    """Digits before `...` are those of an enclosure; margins are cut, and distances rounded up."""
    result = results[name] if name in QUICK else THEOREMS[name].check()
    assert result.verdict == "proved"
    digits, cells = [middle(value) for value in result.digits.values()], CELLS[name]
    for number in re.findall(r"(-?[\d.]+?)\.\.\.", " ".join(cells)):
        assert any(value.startswith(number) for value in digits), number
    margins, cut = [*result.margins.values()], []
    if name in (*HORSESHOES, "horseshoe-smooth"):
        cut = cells[2].split(", ")
    elif name.startswith("entropy"):
        cut = cells[4].split(", ")
    elif name in CURVES:
        cut = cells[4:5]
        assert 0.5 < float(middle(result.digits["distance"])) / float(cells[5]) <= 1
    assert len(cut) in (0, 1, len(margins))
    for text, margin in zip(cut, margins, strict=False):
        assert 1 <= margin / float(text) < 1.3


def test_each_theorem_has_premises_whose_functions_exist():
    groups = tomllib.loads((FOLDER / "theorems" / "premises.toml").read_text(encoding="utf-8"))
    assert {name for group in groups["group"] for name in group["theorems"]} == {*THEOREMS}
    files = [*FOLDER.glob("*/*.py"), ROOT / "src/pseudorigid/verified/flight.py"]
    defined = set(re.findall(r"(?:def|class) (\w+)", "".join(f.read_text() for f in files)))
    for group in groups["group"]:
        assert not group["proof"] or (FOLDER / "theory" / group["proof"]).is_file()
        for premise, functions in group["premises"]:
            names = re.findall(r"`(?:[\w.]*\.)?(\w+)`", functions)
            assert names and {*names} <= defined, (premise, {*names} - defined)


# ---- digits against other methods


@pytest.mark.parametrize("theta", ["0.4", "1.1", "1.5", "2.3"])
def test_the_closed_forms_of_the_fixed_point_are_those_of_the_package(theta):
    """Which test_derivations.py compares with computer algebra."""
    with ctx.workprec(200):
        k, t, step = arb("0.2"), arb(theta), arb(2) ** -60
        assert float(trace_at(k, t)) == pytest.approx(fixed_point.trace_at(0.2, float(theta)))
        energy = fixed_point.energy(0.2, float(theta))
        assert float(energy_at(k, arb(3), t)) == pytest.approx(9 * energy)
        slope = (trace_at(k, t + step) - trace_at(k, t - step)) / (2 * step)
        assert abs(slope - slope_at(k, t)) < arb("1e-30")


def test_the_dataset_of_a_theorem_has_the_verdict_on_its_certificate(monkeypatch):
    whole = theorem_verdict("six-elliptic").attrs
    assert whole["verdict"] == "proved" and whole["line"] == THEOREMS["six-elliptic"].check().line()
    other = THEOREMS["six-inverse"].text()
    monkeypatch.setattr(type(THEOREMS["six-elliptic"]), "text", lambda theorem: other)
    broken = theorem_verdict("six-elliptic").attrs
    assert broken["verdict"] == "not proved"
    assert broken["line"] == THEOREMS["six-elliptic"].check(other).line() != whole["line"]


def test_a_record_of_a_theorem_names_its_certificate_alone_and_the_checkers():
    specs = config.load(ROOT / "config.yaml").build_specs()
    for name in THEOREMS:
        sources = specs[f"results/theorems/theorem_{name}.nc"].sources
        certificates = [file for file in sources if file.endswith(".toml")]
        assert certificates == [f"{CERTIFICATES}/{THEOREMS[name].certificate}"]
        assert {f"src/extensions/proofs/checkers/{each}.py" for each in ("curve", "twist")} <= {
            *sources
        }


@pytest.mark.parametrize(("name", "bound"), [
    ("jump-set", "length"), ("entropy", "entropy"), ("curve-fixed-point-outer", "share"),
])  # fmt: skip
def test_the_readme_has_the_bound_of_a_theorem(name, bound):
    assert f" {float(THEOREMS[name].bounds[bound]):g}" in README
