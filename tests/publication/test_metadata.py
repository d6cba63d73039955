"""The metadata files are valid, and invent nothing."""

import json
import subprocess

import pytest
import yaml
from project import check_jsonschema

from pipeline import config
from pipeline.checks import manifest, published_sets
from pipeline.publication import metadata
from pipeline.records.sources import ROOT


def test_the_citation_fits_the_official_schema(tmp_path):
    whole, schema = (ROOT / metadata.CITATION).read_text(), "vendor.citation-file-format"
    for text, expected in ((whole, 0), (whole.replace("license:", "licence:"), 1)):
        (tmp_path / metadata.CITATION).write_text(text)
        status, output = check_jsonschema("--builtin-schema", schema, tmp_path / metadata.CITATION)
        assert status == expected, output


# What the validator's profile demands beyond CodeMeta: kinds that it lists itself, and what nobody
# has given yet.
NOT_GIVEN = {"applicationCategory", "codeRepository", "identifier", "schema:featureList"}


MISTAKES = [
    ("codemeta.json", '"keywords"', '"keywoords"', "profile.unknown-property"),
    ("codemeta.json", '"SoftwareSourceCode"', '"Periodical"', "profile.invalid-type"),
    ("codemeta.json", '"version": "', '"version": "9', "consistency.mismatch"),
    (".zenodo.json", '"version": "', '"version": "9', "consistency.mismatch"),
    (".zenodo.json", "BSD-3-Clause", "MIT", "consistency.mismatch"),
    (".zenodo.json", '"keywords"', "keywords", "source.unreadable"),
]


@pytest.mark.slow
def test_a_validator_accepts_the_files_and_finds_mistakes(environment_of, tmp_path):
    validator = environment_of("metadata").with_name("rs-metadata")
    whole = {name: (ROOT / name).read_text() for name in (metadata.CITATION, *metadata.pages())}

    def found(texts):
        for name, text in texts.items():
            (tmp_path / name).write_text(text)
        command = [validator, "validate", "--format", "json", tmp_path]
        result = subprocess.run(command, check=False, capture_output=True, text=True)
        return {
            each["code"]
            for each in json.loads(result.stdout)["diagnostics"]
            if each["severity"] != "info"
            and each["code"] != "recommendation.missing"
            and each.get("property") not in NOT_GIVEN
        }

    assert found(whole) == set()
    for name, old, new, code in MISTAKES:
        assert old in whole[name]
        assert found(whole | {name: whole[name].replace(old, new)}) >= {code}


def test_each_published_figure_is_in_the_codecheck_manifest():
    listed = yaml.safe_load((ROOT / "codecheck.yml").read_text())["manifest"]
    published = {
        f"{each.folder}/{name}"
        for each in published_sets.committed_sets(config.load(ROOT / "config.yaml"))
        for name in manifest.sums(manifest.read(ROOT, each.folder))
    }
    assert {entry["file"] for entry in listed} == published
    assert all(entry["comment"] for entry in listed)


def test_what_nobody_has_given_is_left_out_or_marked():
    assert "doi, of the archived software" in metadata.missing(metadata.citation())
    assert "doi" not in (ROOT / ".zenodo.json").read_text()
    assert f"doi: ''  # {metadata.TO_FILL_IN}" in (ROOT / "metadata.yaml").read_text()


def test_what_is_given_reaches_every_file(monkeypatch):
    author = {"given-names": "Ann", "family-names": "Bee", "orcid": "https://orcid.org/0-1"}
    facts = metadata.citation() | {
        "authors": [author],
        "doi": "10.1/x",
        "repository-code": "https://example.org/x",
        "date-released": "2026-01-01",
    }
    assert not metadata.missing(facts)
    assert metadata.addresses(facts) == ["https://example.org/x", "https://doi.org/10.1/x"]
    monkeypatch.setattr(metadata, "citation", lambda: facts)
    assert json.loads(metadata.pages()[".zenodo.json"])["creators"][0]["name"] == "Bee, Ann"
    for name, text in metadata.pages().items():
        given = [
            "Bee",
            "0-1",
            *(["10.1/x", "https://example.org/x"] if name != ".zenodo.json" else []),
        ]
        assert [words for words in given if words not in text] == [], name
