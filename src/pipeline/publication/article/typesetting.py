"""Set the article with typst, whose package brings the compiler and the fonts."""

from pathlib import Path

_SOURCE = Path(__file__).with_name("article.typ")


class TypesettingError(ValueError):
    """The article cannot be set. The message is one line."""


def typeset(root: Path, numbers: Path, source: Path = _SOURCE) -> bytes:
    """Return the PDF of the article, which takes its numbers from a JSON file in `root`.

    The bytes depend on the text, the numbers, the pictures and the version of typst alone. The PDF
    is tagged (PDF/UA-1). Warnings of typst are errors.
    """
    import typst

    try:
        pdf, problems = typst.compile_with_warnings(
            str(source),
            root=str(root),
            ignore_system_fonts=True,
            sys_inputs={"data": f"/{numbers.relative_to(root)}"},
            pdf_standards=["ua-1"],
        )
    except (RuntimeError, typst.TypstError) as error:
        raise TypesettingError(" ".join(str(error).split())) from None
    if problems:
        raise TypesettingError("; ".join(problem.message for problem in problems))
    return bytes(pdf)
