"""The settings of Sphinx: pages in Markdown (MyST), docstrings by numpydoc, formulas as MathML.

The folder of the sources has the repository's entries and a folder `pages`, which build.py writes.
"""

import re
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml

project = "pseudorigid"
root_doc = "README"
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc"]
include_patterns = ["*.md", "pages/*.md", "docs/**.md", "src/**.md", "tests/README.md"]
exclude_patterns = ["config", "results", "src/pipeline"]
default_role = "literal"
highlight_language = "none"
myst_enable_extensions = ["colon_fence", "dollarmath", "html_image"]
myst_heading_anchors = 4
numpydoc_show_class_members = False
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}

html_theme = "furo"
html_title = "pseudorigid"
html_static_path = ["site.css", "filter.js"]
html_css_files = ["site.css"]
html_js_files = [("filter.js", {"defer": "defer"})]
html_copy_source = html_show_sourcelink = html_show_sphinx = html_show_copyright = False
smartquotes = False  # it takes f'' for a quotation mark
html_permalinks_icon = "#"
html_math_renderer = "mathml"
html_scaled_image_link = False  # a picture of README leads to its caption
html_sidebars = {
    "**": [
        *(f"sidebar/{name}.html" for name in ("brand", "search", "scroll-start", "navigation")),
        "beside.html",
        "sidebar/scroll-end.html",
    ]
}
templates_path = ["."]
HERE = Path(__file__).parent
# Space around a function, none around a bar, a slash or a prime, which browsers would add.
SPACES: tuple[tuple[str, Any], ...] = (
    (r"<mi>([a-z]{2,})</mi>", r'<mo form="prefix" lspace="0.17em" rspace="0.17em">\1</mo>'),
    (r"<mo(?: [^>]*)?>([|/])</mo>", r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>'),
    (r"<mo>('+)</mo>", lambda found: f'<mo lspace="0" rspace="0">{"′" * len(found[1])}</mo>'),
)


def _formula(translator: Any, node: Any) -> None:
    """Write a formula as MathML, which needs no script."""
    formula = tex2mathml(node.astext(), as_block=isinstance(node, nodes.math_block))
    for mark, spaced in SPACES:
        formula = re.sub(mark, spaced, formula)
    translator.body.append(formula)
    raise nodes.SkipNode


def _with_contents(app: Any, name: str, source: list[str]) -> None:
    """Add doors and the table of contents to the first page, which GitHub shows without them."""
    if name == root_doc:
        doors, contents = ((HERE / f"{n}.txt").read_text("utf-8") for n in ("doors", "contents"))
        title, line, rest = source[0].partition("\n")
        # A link of MyST to a heading loses a picture inside.
        linked = r"\[(<img [^>]*>)\]\((docs/\w+)\.md(#[^)]*)\)"
        rest = re.sub(linked, r'<a href="\2.html\3">\1</a>', rest)
        source[0] = f"{title}{line}\n{doors}{rest}\n{contents}"


def _accessible(app: Any, name: str, template: str, context: dict[str, Any], tree: Any) -> None:
    """Give the captions of the menu a level, and let keys scroll what is wider than the window."""
    menu = context["furo_navigation_tree"]
    context["furo_navigation_tree"] = menu.replace(
        'role="heading"', 'role="heading" aria-level="2"'
    )
    wide = r'<(pre|div class="(?:table|math)-wrapper[^"]*")>'
    context["body"] = re.sub(wide, r'<\1 tabindex="0">', context.get("body", ""))


def setup(app: Any) -> None:
    """Register the functions above."""
    app.add_html_math_renderer("mathml", (_formula, None), (_formula, None))
    app.connect("source-read", _with_contents)
    app.connect("html-page-context", _accessible, priority=900)
