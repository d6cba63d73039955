"""Scripts and styles without comments and spaces that nobody reads in the finished page.

The scripts of `web/` end each statement with a semicolon, and a template literal in them holds no
other one; so a space or a line break beside a sign may go.
"""

import re

_SIGN = r"[{}()\[\];,:?=<>&|!*/%^~+\-]"
_TOKEN = re.compile(
    r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
    |(?P<kept>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`
      |(?<=[=(]\s)/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n])+/[a-z]*
      |(?<=[(])/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n])+/[a-z]*
      |(?<=return\s)/(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n])+/[a-z]*)
    |(?P<space>\s+)
    |(?P<other>[\w$]+|.)
    """,
    re.VERBOSE | re.DOTALL,
)


def script(text: str) -> str:
    """Return a script that does the same."""
    parts: list[str] = []
    space = False
    for match in _TOKEN.finditer(text):
        if match.lastgroup in ("comment", "space"):
            space = True
            continue
        part = match.group()
        if space and parts and _needs_space(parts[-1][-1], part[0]):
            parts.append(" ")
        parts.append(part)
        space = False
    return "".join(_joined(parts)) + "\n"


def _joined(parts: list[str]) -> list[str]:
    """Return the parts with one `let` for declarations that follow each other."""
    declares, before = [False], ""
    joined: list[str] = []
    for part in parts:
        word = "let" if part == "const" else part
        if part in "([{":
            declares.append(False)
        elif part in ")]}":
            declares.pop()
        if word == "let" and before == ";" and declares[-1]:
            joined[-1] = ","
            before = ","
            continue
        if before == "," and part == " " and joined[-1] == ",":
            continue
        if before == ";":
            declares[-1] = False
        if word == "let":
            declares[-1] = True
        joined.append(word)
        before = part if part != " " else before
    return joined


def _needs_space(before: str, after: str) -> bool:
    """Return whether two signs or words would mean something else without a space."""
    if before == after and before in "+-":
        return True
    if before == "/" or after == "/":
        return True  # a regular expression, or a comment's first half
    return not (
        re.match(_SIGN, before) or re.match(_SIGN, after) or before in "\"'`" or after in "\"'`"
    )


def style(text: str) -> str:
    """Return a style sheet that means the same."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r"\s+", " ", text)
    return re.sub(r" ?([{};,]) ?", r"\1", text).replace(": ", ":").strip()


def markup(text: str) -> str:
    """Return HTML without the spaces at the beginnings of its lines."""
    return "\n".join(line.strip() for line in text.splitlines()) + "\n"
