"""README.md, its bar and CLAIMS.md count the statements as CLAIMS.json has them."""

import re

from extensions.claims import ledger
from extensions.claims.ledger import bar
from helpers.project import ROOT

ROWS = ledger.read_json((ROOT / ledger.DATA).read_text(encoding="utf-8"))


def test_all_pages_count_the_statements_alike():
    """README has the numbers by hand."""
    names = "README.md", "CLAIMS.md", bar.FILE
    pages = {n: " ".join((ROOT / n).read_text(encoding="utf-8").split()) for n in names}
    assert f"statements: {bar.sentence(ROWS)}" in pages[bar.FILE]
    assert bar.sentence(ROWS) in pages["README.md"]
    for page in pages.values():
        found = re.findall(r"\b(\d+) (?:checkable )?statements", page)
        assert found and {*found} == {str(ledger.checkable_count(ROWS))}
    (row,) = (row for row in ROWS if row.number == 40)
    (exponent,) = re.findall(r"converge to ([\d.]+);", row.value)
    # The pages have the mean of more orbits than the claim, which lies within its error.
    found = re.findall(r"(0\.\d+) ± (0\.\d+)", pages["README.md"])
    ((mean, error),) = found
    assert f"{mean} ± {error}" in (ROOT / "docs/findings.md").read_text(encoding="utf-8")
    assert abs(float(mean) - float(exponent)) < float(error) < 1e-4
