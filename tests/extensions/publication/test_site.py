"""./reproduce site and article: what is not as committed is not published, nothing is deleted."""

import json
import re
from collections import defaultdict
from contextlib import nullcontext
from urllib.parse import unquote

import pytest

from extensions.explorer import page as explorer
from extensions.publication.commands import article, site
from helpers.parts.archives import DATA, forge
from helpers.parts.outline import Outline
from helpers.project import ROOT, SHIPPED
from pipeline import config
from pipeline.cli import publishing
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import UsageError

_SCROLLS = "scrollable-region-focusable"  # axe's rule on parts that keys cannot scroll
BESIDE = ("explorer.html", "article.html", "article.pdf")  # of other writers than Sphinx


def write(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)


@pytest.mark.parametrize("name", ["mine.txt", "paper/mine.txt", "more/index.html"])
def test_a_file_that_the_command_did_not_write_is_refused(tmp_path, name):
    write(tmp_path, "index.html", "paper/orbits_fig2.nc")
    (tmp_path / site.LIST).write_text(f"index.html\npaper/orbits_fig2.nc\n{site.LIST}\n")
    site._refuse_others(tmp_path)
    write(tmp_path, name)
    with pytest.raises(ValueError, match=re.escape(f"{name} was not written by this command")):
        site._refuse_others(tmp_path)


@pytest.mark.parametrize("command", [site, article])
def test_results_that_are_not_the_committed_ones_are_named_and_not_published(
    command, moved, monkeypatch
):
    """One was edited by hand: its record fits, only the manifest tells."""
    forge(moved, DATA)
    monkeypatch.setattr(command, "ROOT", moved.path)
    monkeypatch.setattr(command, "locked", nullcontext)
    monkeypatch.setattr(publishing, "make", lambda *_: 0)
    args = Arguments(config=config.load(moved.config), dry_run=False, options=[])
    name = command.__name__.rpartition(".")[2]
    with pytest.raises(UsageError, match=rf"^{name}: [^\n]*{DATA}[^\n]*$"):
        command.run(args)
    assert not [*(moved.path / "results").glob("*site*"), *moved.path.glob("results/article*")]


def test_the_explorer_may_be_anywhere():
    """Its page is in results/, in the site, in archives and where people copy it."""
    text = (ROOT / explorer.COPY).read_text(encoding="utf-8")
    stored = re.search(r'<script type="application/json" id="data">(.*?)</script>', text)
    data = json.loads(stored[1])["citation"]["links"].values()
    fixed = re.findall(r'<a [^>]*href="?([^">\s]+)', text.partition("<script")[0])
    assert all(link.startswith(("#", "https://", "data:")) for link in (*data, *fixed))
    own = re.findall('href="([^"]*)"', site._LINKS)
    assert {*own} <= {*BESIDE, "index.html"}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The pages of this tree, without those that other writers than Sphinx make."""
    pytest.importorskip("furo", reason="./reproduce site installs it")
    from extensions.publication.site.build import build

    folder = tmp_path_factory.mktemp("site") / "pages"
    build(ROOT, config.load(SHIPPED), folder)
    return folder


@pytest.mark.slow
def test_links_of_the_site_have_targets_and_pages_load_nothing_from_elsewhere(built):
    ids, links = {}, defaultdict(set)
    for file in built.rglob("*.html"):
        tags = Outline(file.read_text(encoding="utf-8"), closed=False).tags
        ids[file] = {attributes["id"] for _, attributes in tags if "id" in attributes}
        links[file] = {
            attributes["href"] for tag, attributes in tags if tag == "a" and "href" in attributes
        }
        loaded = [
            a.get("src") or a.get("href", "") for tag, a in tags if tag in ("img", "script", "link")
        ]
        assert not [each for each in loaded if re.match(r"(https?:)?//", each)], file
    assert len(links) > 60
    for file, found in links.items():
        for link in found:
            path, _, place = unquote(link).partition("#")
            if re.match(r"(https?|mailto):", link) or path.rpartition("/")[2] in BESIDE:
                continue
            target = (file.parent / path).resolve() if path else file
            assert target.is_file(), (file, link)
            assert not place or target not in ids or place in ids[target], (file, link)


@pytest.mark.slow
def test_what_is_missing_stops_the_site(built, tmp_path, monkeypatch):
    """A link without a target is a warning of Sphinx, and so an error of one line."""
    from extensions.publication.site import build

    written = build.pages(ROOT, config.load(SHIPPED)) | {"run": "# Run\n\n[gone](gone.md)\n"}
    monkeypatch.setattr(build, "pages", lambda *_: written)
    with pytest.raises(ValueError, match=r"^[^\n]*gone\.md[^\n]*$"):
        build.build(ROOT, config.load(SHIPPED), tmp_path / "site")


@pytest.fixture
def chromium(tmp_path):
    from helpers.parts import browsers

    with browsers.started("chromium", tmp_path) as started:
        yield started


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_no_serious_fault_on_any_page_of_the_site(built, chromium, width):
    from axe_core_python.selenium import Axe

    pages, found = sorted(built.rglob("*.html")), {}
    chromium.resize(width, 800)
    for page in pages:
        chromium.open(page.as_uri())
        violations = Axe().run(chromium.driver, options={"resultTypes": ["violations"]})
        for each in violations["violations"]:
            # Later versions of axe call the second one serious.
            if each["impact"] in ("serious", "critical") or each["id"] == _SCROLLS:
                found[page.name, each["id"]] = each["nodes"][0]["html"]
        if chromium.run("return document.documentElement.scrollWidth > innerWidth"):
            found[page.name, "wider than the window"] = ""
    assert len(pages) > 60 and not found


@pytest.mark.slow
def test_the_gallery_has_three_cards_in_a_row_and_statements_are_filtered(built, chromium):
    chromium.resize(1280, 800)
    chromium.open((built / "pages" / "gallery.html").as_uri())
    cards = "[...document.querySelectorAll('.card')]"
    across, high = chromium.run(
        f"const tops = {cards}.map(e => e.getBoundingClientRect().top);"
        "return [tops.filter(t => t === tops[0]).length, document.body.scrollHeight]"
    )
    assert across == 3 and high <= 4500
    chromium.open((built / "CLAIMS.html").as_uri())
    shown = "return [...document.querySelectorAll('section[id^=statement-]')]"
    count = f"{shown}.filter(e => e.checkVisibility()).length"
    every = chromium.run(count)
    chromium.run(
        "const f = document.querySelector('.filter'); f.verdict.value = 'Does not hold';"
        "f.dispatchEvent(new Event('input'))"
    )
    assert (chromium.run(count), every) == (2, 74)
    chromium.run("location.hash = 'statement-40'; await new Promise(r => setTimeout(r, 300))")
    assert chromium.run(count) == every and chromium.errors() == []
