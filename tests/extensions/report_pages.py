"""The report as a page, and the tags of pages."""

from html.parser import HTMLParser

from extensions.report import page
from pipeline import config

PAGE = "results/report/report.html"


class Outline(HTMLParser):
    """The tags of a page with their attributes; each tag must be closed."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.open = [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "link", "img", "wbr", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, self.getpos()

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def rendered(tree, **how):
    html = page.render(tree.path, config.load(tree.config), **how)
    Outline(html)
    return html
