"""The tags of HTML pages."""

from html.parser import HTMLParser


class Outline(HTMLParser):
    """The tags of a page with their attributes; unless told otherwise, each must be closed."""

    def __init__(self, text, closed=True):
        super().__init__()
        self.tags, self.open, self.closed = [], [], closed
        self.feed(text)
        assert not closed or self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "link", "img", "wbr", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert not self.closed or self.open.pop() == tag, self.getpos()

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]
