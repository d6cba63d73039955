"""Snakemake's own report shows the figures with their captions, without a network."""

import html
import json
import re
import zipfile

import pytest

from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import facts, measured
from pipeline.config import load

NOWHERE = "http://127.0.0.1:9"


@pytest.mark.slow
@pytest.mark.parametrize("extension", ["html", "zip"])
def test_the_report_has_each_figure_with_its_caption(extension, done):
    file = done.path / f"report.{extension}"
    proxies = {"http_proxy": NOWHERE, "https_proxy": NOWHERE, "no_proxy": ""}
    result = done.python("-m", "snakemake", "--report", file.name, **proxies)
    assert result.returncode == 0, result.stderr
    if extension == "zip":
        with zipfile.ZipFile(file) as parts:
            page = parts.read("report/report.html").decode()
            assert sum("/fig" in name for name in parts.namelist()) == 14
    else:
        page = file.read_text(encoding="utf-8")
    results, _ = json.JSONDecoder().raw_decode(page[page.index('{"results/paper/figures/') :])
    drawn = [f"results/paper/figures/fig{n}.{kind}" for n in range(2, 9) for kind in ("png", "svg")]
    assert sorted(results) == sorted(drawn)
    config = load(done.config)
    scenes = config.scenes
    for path, shown in results.items():
        labels, caption = shown["labels"], html.unescape(shown["caption"])
        assert path.endswith("figures/{figure}.{format}".format(**labels))
        scene = labels["figure"]
        known = measured(done.path, config, "paper", scene, facts)
        words = caption_of(scene, scenes[scene].as_mapping(), known)
        first, *others = re.findall(r"<p>(.*?)</p>", caption, re.DOTALL)
        assert first == f"{words.name}: {words.title}"
        assert others == [*filter(None, (words.shows, words.see, words.details))]
