"""Set the article with typst, whose package brings the compiler and the fonts."""

import re
from pathlib import Path
from typing import Any
from unicodedata import normalize

_SOURCE = Path(__file__).with_name("article.typ")
_STYLE = Path(__file__).with_name("article.css")
# typst says this of every page: its export may change, but its version is pinned.
_KNOWN = "html export is under active development and incomplete"
_FORMULA = re.compile(r'<span data-alt="([^"]*)"><math\b(.*?)</span>', re.DOTALL)
_LETTER, _PLAIN = re.compile(r"<mi>([^\x00-\x7f])</mi>"), '<mi mathvariant="normal">{}</mi>'
_COMBINING_DOT, _DOT = "<mo>\u0307</mo>", "<mo>\u02d9</mo>"
_HEAD = """\
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; \
style-src 'unsafe-inline'">
<link rel="icon" href="data:,">
<style>
{style}</style>
</head>"""


def typeset(root: Path, numbers: str, source: Path = _SOURCE) -> bytes:
    """Return the PDF of the article, which takes its numbers from JSON, and pictures from `root`.

    The bytes depend on the text, the numbers, the pictures and the version of typst alone. The PDF
    is tagged (PDF/UA-1). Errors and warnings of typst are a ValueError of one line.
    """
    return _compiled(root, numbers, source, pdf_standards=["ua-1"])


def web_page(root: Path, numbers: str, source: Path = _SOURCE) -> bytes:
    """Return the article as one HTML page, with the figures in it and formulas in MathML.

    Formulas need no mathematical font, which readers may lack: letters are plain ones, which the
    style slants, and a dot has a width, without which Chromium draws it beside the letter.
    """
    page = _compiled(root, numbers, source, format="html").decode()
    page = _LETTER.sub(lambda found: _PLAIN.format(normalize("NFKC", found[1])), page)
    page = page.replace(_COMBINING_DOT, _DOT)
    # Chromium names a formula by aria-label, other programs by alttext.
    page = _FORMULA.sub(r'<math aria-label="\1" alttext="\1"\2', page)
    head = _HEAD.format(style=_STYLE.read_text(encoding="utf-8"))
    return page.replace("</head>", head, 1).encode()


def _compiled(root: Path, numbers: str, source: Path, **options: Any) -> bytes:
    """Return the document that typst compiles; raises ValueError for errors and warnings."""
    import typst

    inputs = {"data": numbers, "format": options.get("format", "pdf")}
    try:
        compiled, problems = typst.compile_with_warnings(
            str(source), root=str(root), ignore_system_fonts=True, sys_inputs=inputs, **options
        )
    except (RuntimeError, typst.TypstError) as error:
        raise ValueError(" ".join(str(error).split())) from None
    if problems := [each.message for each in problems if each.message != _KNOWN]:
        raise ValueError("; ".join(problems))
    return compiled.encode() if isinstance(compiled, str) else bytes(compiled)
