"""CLAIMS.md: a row a claim, the corrections first; written, and read again."""

import re

from . import CLAIMS, DOCUMENT, VERDICTS

COLUMNS = ("number", "place", "words", "value", "error", "evidence")


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
    rows = {word: [] for word in VERDICTS}
    for number in sorted(verdicts):
        rows[verdicts[number].verdict].append(_row(CLAIMS[number], verdicts[number]))
    lines = [DOCUMENT.head, f"The verdicts on {len(verdicts)} statements, and what each needs:", ""]
    lines += ["| verdict | rows | what it needs |", 3 * "|---" + "|"]
    lines += [f"| {word} | {len(rows[word])} | {needs} |" for word, needs in VERDICTS.items()]
    lines.append("")
    for word, found in rows.items():
        if found:
            lines += [f"## {word.capitalize()}", ""]
            lines += ["| | where | statement | our value | error | look at |", 6 * "|---" + "|"]
            lines += [*found, ""]
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
    """The line of a claim in a table."""
    quoted = f"\N{LEFT DOUBLE QUOTATION MARK}{claim.quote}\N{RIGHT DOUBLE QUOTATION MARK}"
    cells = (str(claim.number), claim.place, quoted if claim.quote else claim.paraphrase)
    cells += (verdict.value, verdict.error, verdict.evidence)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
