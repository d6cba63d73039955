"""docs/figures.md has a whole caption of each committed picture, once."""

import re

from extensions.publication.figures_page import _captions, page
from helpers.examples import assert_decided


def test_no_caption_has_a_condition_or_points_to_another_picture():
    shown = [caption for _, of in _captions() for caption in of.values()]
    for caption in shown:
        assert_decided(caption, [each.name for each in shown])


def test_no_caption_or_name_is_on_the_page_twice():
    parts = page().split("\n### ")[1:]
    names = [part.partition(":")[0] for part in parts]
    texts = [part.partition(")\n\n")[2].partition("\n## ")[0] for part in parts]
    assert len(set(names)) == len(set(texts)) == len(parts)
    for families in [part for part in parts if part.startswith("families/energy: ")]:
        assert "positions" in families and "missed impacts" not in families


def test_the_page_has_whole_captions():
    text = " ".join(page().split())
    for published, captions in _captions():
        for scene, caption in captions.items():
            file = f"{published.folder}/{scene}.png"
            (own,) = re.findall(rf"/{re.escape(file)}\) (.*?)(?= ###?#? |$)", text)
            assert own == " ".join(filter(None, caption[2:5]))
