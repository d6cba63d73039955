"""CLAIMS.md: a row a claim, the corrections first; written, and read again."""

import re

from . import CLAIMS
from .ledger import VERDICTS

COLUMNS = ("number", "place", "words", "value", "error", "evidence")
HEAD = """# The paper's statements, checked

E. Kanso and P. Papadopoulos, *Dynamics of pseudo-rigid ball impact on rigid foundation* (to appear
in the International Journal of Non-Linear Mechanics; the preprint is what was read). Each row is a
statement of the paper, in its own words between quotation marks, else in ours; our value with its
error; and what to look at. A statement that the paper repeats has one row, and the place of each;
what it says of the literature is judged in rows 51 and 57 only. `./reproduce claims` writes this
file; `./reproduce claims --check NUMBER --data FILE` judges one claim by another dataset.

An orbit is *regular* if a tangent vector grows along it in proportion to the number of impacts, and
not exponentially; what depends on where that line is drawn counts in the interval of a share.
Shares have four decimals, which are exact on the line of energies (2,000 orbits each).
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
    groups = {word: [] for word in VERDICTS}
    for number in sorted(verdicts):
        groups[verdicts[number].verdict].append(number)
    lines = [HEAD, f"The verdicts on {len(verdicts)} statements, and what each needs:", ""]
    lines += ["| verdict | rows | what it needs |", 3 * "|---" + "|"]
    lines += [f"| {word} | {len(groups[word])} | {needs} |" for word, needs in VERDICTS.items()]
    lines.append("")
    for word in VERDICTS:
        if not groups[word]:
            continue
        lines += [f"## {word.capitalize()}", ""]
        lines += ["| | where | statement | our value | error | look at |", 6 * "|---" + "|"]
        lines += [_row(CLAIMS[number], verdicts[number]) for number in groups[word]]
        lines.append("")
    return "\n".join(lines)


def read(text):
    """The rows of a CLAIMS.md, in its order.

    Returns
    -------
    list of dict
        verdict, one of VERDICTS, and number, place, words, value, error, evidence: texts.

    Raises
    ------
    ValueError
        Another text.
    """
    words = {word.capitalize(): word for word in VERDICTS}
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
    cells = (
        str(claim.number),
        claim.place,
        words if claim.quoted else claim.words,
        verdict.value,
        verdict.error,
        verdict.evidence,
    )
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
