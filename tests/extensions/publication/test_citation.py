"""CITATION.cff and codecheck.yml are valid and complete."""

import yaml
from project import check_jsonschema

from extensions.publication import citation
from pipeline import config
from pipeline.checks import manifest, published_sets
from pipeline.records.sources import ROOT


def test_the_citation_fits_the_official_schema(tmp_path):
    whole, schema = (ROOT / citation.CITATION).read_text(), "vendor.citation-file-format"
    for text, expected in ((whole, 0), (whole.replace("license:", "licence:"), 1)):
        (tmp_path / citation.CITATION).write_text(text)
        status, output = check_jsonschema("--builtin-schema", schema, tmp_path / citation.CITATION)
        assert status == expected, output


def test_each_published_figure_is_in_the_codecheck_manifest():
    listed = yaml.safe_load((ROOT / "codecheck.yml").read_text())["manifest"]
    published = {
        f"{each.folder}/{name}"
        for each in published_sets.committed_sets(config.load(ROOT / "config.yaml"))
        for name in manifest.sums(manifest.read(ROOT, each.folder))
    }
    assert {entry["file"] for entry in listed} == published
    assert all(entry["comment"] for entry in listed)


def test_what_nobody_has_given_is_listed_until_it_is_given():
    facts = citation.read()
    assert "doi, of the archived software" in citation.missing(facts)
    assert "ORCIDs of the authors" in citation.missing(facts)
    author = {"given-names": "Ann", "family-names": "Bee", "orcid": "https://orcid.org/0-1"}
    facts |= {
        "authors": [author],
        "doi": "10.1/x",
        "repository-code": "https://example.org/x",
        "date-released": "2026-01-01",
    }
    assert not citation.missing(facts)
    assert citation.name_of(author) == "Ann Bee"
    assert citation.addresses(facts) == ["https://example.org/x", "https://doi.org/10.1/x"]
