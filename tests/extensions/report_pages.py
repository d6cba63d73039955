"""The report as a page: its tags, its numbers, and what a browser shows of it."""

import re
import shutil
import subprocess
from html.parser import HTMLParser

from extensions.report import page
from pipeline import config

PAGE = "results/report/report.html"
CHROMIUM = shutil.which("chromium")


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


def article(text, name):
    """Return the article of a committed picture in a page, without its image."""
    text = re.sub('base64,[^"]*', "base64,", text)
    found = re.search(f'<article id="more_figures-{name}[.]png".*?</article>', text, re.DOTALL)
    return found and found.group()


def numbers_without_commas(text):
    """Return the long whole numbers in the words of a page."""
    markup = '<style>.*?</style>|<script>.*?</script>|base64,[^"]*|<[^>]*>'
    words = re.sub(markup, " ", text, flags=re.DOTALL).partition("what made each result")[0]
    return re.findall(r"(?<![\d.,])\d{5,}(?![\d.,])", words)


def with_script(text, script):
    """Return a page that also runs a script."""
    plain = re.sub(r"<meta http-equiv[^>]*>", "", text)
    return plain.replace("</body>", f"<script>{{{script}}}</script></body>")


def in_browser(file):
    """Return a page as chromium has it after its scripts."""
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu"]
    command += ["--allow-file-access-from-files", f"--user-data-dir={file.parent}/profile"]
    command += ["--virtual-time-budget=20000", "--dump-dom", file.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=120).stdout
