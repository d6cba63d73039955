"""CITATION.cff and codecheck.yml are valid and complete."""

import yaml

from extensions.publication.article import numbers
from helpers.project import check_jsonschema
from pipeline import config
from pipeline.checks import manifest, published_sets
from pipeline.records.sources import ROOT


def test_the_citation_fits_the_official_schema(tmp_path):
    file, schema = tmp_path / numbers.CITATION, "vendor.citation-file-format"
    whole = (ROOT / numbers.CITATION).read_text()
    for text, expected in ((whole, 0), (whole.replace("license:", "licence:"), 1)):
        file.write_text(text)
        status, output = check_jsonschema("--builtin-schema", schema, file)
        assert status == expected, output


def test_each_published_figure_is_in_the_codecheck_manifest():
    listed = yaml.safe_load((ROOT / "codecheck.yml").read_text())["manifest"]
    published = {
        f"{each.folder}/{name}"
        for each in published_sets.committed_sets(config.load(ROOT / "config.yaml"))
        for name in manifest.published(manifest.read(ROOT, each.folder))
    }
    assert {entry["file"] for entry in listed} == published
    assert all(entry["comment"] for entry in listed)
