"""CLAIMS.md: a row a claim, the corrections first; written, and read again."""

import re

from . import CLAIMS
from .ledger import CORRECTED, FALSE, HOLDS, NOT_COMPUTED, OPEN, PROVED

ORDER = (FALSE, CORRECTED, OPEN, PROVED, HOLDS, NOT_COMPUTED)
TITLES = {
    FALSE: "Does not hold",
    CORRECTED: "Holds with a correction",
    OPEN: "Open",
    PROVED: "Proved",
    HOLDS: "Holds",
    NOT_COMPUTED: "Not computed",
}
COLUMNS = ("number", "place", "words", "value", "error", "evidence")
HEAD = """# The paper's statements, checked

E. Kanso and P. Papadopoulos, *Dynamics of pseudo-rigid ball impact on rigid foundation* (to appear
in the International Journal of Non-Linear Mechanics; the preprint is what was read). Each row is a
statement of the paper, in its own words between quotation marks, else in ours; what became of it;
our value with its error; and what to look at. `./reproduce claims` writes this file; `./reproduce
claims --check NUMBER --data FILE` judges one claim by another dataset. An orbit is *regular* if a
tangent vector grows along it in proportion to the number of impacts, and not exponentially; what
depends on where that line is drawn counts in the interval of a share.
"""


def render(verdicts):
    """The text of CLAIMS.md.

    Parameters
    ----------
    verdicts : dict from number to Verdict
        As from `judge`, all claims.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        A claim without a verdict.
    """
    missing = sorted(set(CLAIMS) - set(verdicts))
    if missing:
        raise ValueError(f"no verdict on {', '.join(map(str, missing))}")
    groups = {word: [] for word in ORDER}
    for number in sorted(verdicts):
        groups[verdicts[number].verdict.partition(":")[0]].append(number)
    counts = ", ".join(f"{word} {len(groups[word])}" for word in ORDER if groups[word])
    lines = [HEAD, f"The verdicts on {len(verdicts)} statements: {counts}.", ""]
    for word in ORDER:
        if not groups[word]:
            continue
        lines += [f"## {TITLES[word]}", ""]
        lines += ["| | where | statement | our value | error | look at |", 6 * "|---" + "|"]
        lines += [_row(CLAIMS[number], verdicts[number]) for number in groups[word]]
        lines.append("")
    return "\n".join(lines)


def read(text):
    """The rows of a CLAIMS.md, in its order.

    Returns
    -------
    list of dict
        verdict, a word of ORDER, and number, place, words, value, error, evidence: texts.

    Raises
    ------
    ValueError
        Another text.
    """
    words = {title: word for word, title in TITLES.items()}
    found, verdict = [], None
    for line in text.splitlines():
        if line.startswith("## "):
            verdict = words.get(line[3:])
        elif re.match(r"\| \d+ \|", line):
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            cells = [cell.replace("\\|", "|") for cell in cells]
            if verdict is None or len(cells) != len(COLUMNS):
                raise ValueError(f"not a table of claims: {line[:60]}")
            found.append({"verdict": verdict, **dict(zip(COLUMNS, cells, strict=True))})
    if not found:
        raise ValueError("not a table of claims")
    return found


def _row(claim, verdict):
    words = f"\N{LEFT DOUBLE QUOTATION MARK}{claim.words}\N{RIGHT DOUBLE QUOTATION MARK}"
    why = verdict.verdict.partition(": ")[2]
    cells = (
        str(claim.number),
        claim.place,
        words if claim.quoted else claim.words,
        why or verdict.value,
        verdict.error,
        verdict.evidence,
    )
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
