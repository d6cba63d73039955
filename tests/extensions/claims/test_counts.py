"""README.md, its bar and CLAIMS.md count the statements as CLAIMS.json has them."""

import re

from project import ROOT

from extensions.claims import ledger
from extensions.claims.ledger import bar

ROWS = ledger.read_json((ROOT / ledger.DATA).read_text(encoding="utf-8"))


def test_all_pages_count_the_statements_alike():
    """README has the numbers by hand."""
    names = "README.md", "CLAIMS.md", bar.FILE
    pages = {n: " ".join((ROOT / n).read_text(encoding="utf-8").split()) for n in names}
    for name in ("README.md", bar.FILE):
        of = " of the paper" * (name != bar.FILE)
        assert f"statements{of}: {bar.sentence(ROWS)}" in pages[name]
    for page in pages.values():
        found = re.findall(r"\b(\d+) (?:checkable )?statements", page)
        assert found and {*found} == {str(ledger.checkable_count(ROWS))}
    (row,) = (row for row in ROWS if row.number == 40)
    (exponent,) = re.findall(r"converge to ([\d.]+);", row.value)
    assert f"{exponent} ± {row.error.partition(',')[0]}" in pages["README.md"]
