"""The part of the report on the statements: counts, corrections, and a table with a filter."""

import re
import shutil
from collections import Counter

import pytest
from project import ROOT, Tree
from report_pages import CHROMIUM, in_browser, numbers_without_commas, rendered, with_script

from extensions.claims import ledger
from extensions.claims.ledger.outcomes import CORRECTED, FALSE

ROWS = ledger.read_json((ROOT / ledger.DATA).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def tree(shared, reported):
    """A copy of `reported` with the committed verdicts."""

    def make(folder):
        shutil.copy(ROOT / ledger.DATA, reported.copy(folder).path)

    return Tree(shared("reported with verdicts", make))


@pytest.fixture(scope="module")
def text(tree):
    return rendered(tree)


def test_the_first_screen_counts_the_verdicts(text):
    first, _, _ = text.partition("<main")
    for verdict, count in Counter(row.verdict for row in ROWS).items():
        assert f'data-pick="{verdict}">{verdict}: {count}<' in first
    assert len(re.findall(r'<tr role="row" id="claim-\d+" data-verdict="holds">', text)) == sum(
        row.verdict == "holds" for row in ROWS
    )


def test_corrections_first_and_the_whole_table(text):
    wrong = [row for row in ROWS if row.verdict in (FALSE, CORRECTED)]
    assert len(ROWS) == len(ledger.CLAIMS) and 0 < len(wrong) < len(ROWS)
    above, _, whole = text.partition('id="claims"')
    assert {f'href="#claim-{row.number}"' for row in wrong} == set(
        re.findall(r'href="#claim-\d+"', above)
    )
    assert len(re.findall(r'<tr role="row" id="claim-\d+" ', whole)) == len(ROWS)
    assert not numbers_without_commas(text)


def test_without_readable_verdicts_a_sentence_says_so(tree, tmp_path):
    copy = tree.copy(tmp_path / "damaged")
    (copy.path / ledger.DATA).write_text("nothing <b> of the kind")
    assert "no readable <code>CLAIMS.json</code>" in rendered(copy)


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
    (tmp_path / "page.html").write_text(with_script(text, look))
    dom = in_browser(tmp_path / "page.html")
    proved = sum(row.verdict == "proved" for row in ROWS)
    whole, shown, found, after = map(int, re.search(r"<title>([\d ]+)<", dom)[1].split())
    assert (whole, shown, after) == (len(ROWS), proved, len(ROWS))
    assert 1 <= found < 10
