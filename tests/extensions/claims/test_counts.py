"""README.md and CLAIMS.md count the statements as CLAIMS.json has them."""

import re

from project import ROOT

from extensions.claims import ledger

ROWS = ledger.read_json((ROOT / ledger.DATA).read_text(encoding="utf-8"))


def test_all_pages_count_the_statements_alike():
    """README has the number by hand."""
    pages = {name: (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "CLAIMS.md")}
    for page in pages.values():
        found = re.findall(r"\b(\d+) (?:checkable )?statements", page)
        assert found and {*found} == {str(ledger.checkable_count(ROWS))}
    (row,) = (row for row in ROWS if row.number == 40)
    (exponent,) = re.findall(r"converge to ([\d.]+);", row.value)
    assert f"{exponent} ± {row.error.partition(',')[0]}" in pages["README.md"]
