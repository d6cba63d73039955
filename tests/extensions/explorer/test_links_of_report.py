"""Links from the report to scenes in the explorer."""

from report_pages import Outline, rendered

from extensions.explorer.data import collect
from pipeline import config


def links(html):
    return [a["href"] for a in Outline(html).all("a") if "explorer.html" in a["href"]]


def test_a_link_opens_the_scene_of_a_figure(reported):
    found = links(rendered(reported))
    assert "../explorer.html" in found
    assert all(link.startswith("../explorer.html") for link in found)
    assert (reported.path / "results/explorer.html").is_file()
    opened = {link.partition("#")[2] for link in found} - {""}
    scenes = {*collect(config.load(reported.config), reported.path)["scenes"]}
    assert {"fig3", "fig6", "fig7", "low/fig3"} <= opened <= scenes


def test_in_the_site_the_explorer_is_beside_the_report(reported):
    found = links(rendered(reported, beside={"Article": "article.html"}))
    assert found and all(link.startswith("explorer.html") for link in found)
