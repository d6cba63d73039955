"""config.schema.json accepts config.yaml and refuses mistakes in one value."""

import pytest

from helpers.examples import example
from helpers.project import ROOT, SHIPPED, check_jsonschema
from pipeline.config.schema.kinds import KINDS


def check(text, folder):
    """Check a config by the schema: return the exit status and what is printed."""
    (folder / "config.yaml").write_text(text)
    return check_jsonschema("--schemafile", ROOT / "config.schema.json", folder / "config.yaml")


def test_the_config_and_the_example_of_each_kind_are_accepted(tmp_path):
    text = SHIPPED.read_text()
    for kind in (name for name in KINDS if KINDS[name].model_fields["formats"].default):
        block = "".join(f"    {line}\n" for line in example(kind).splitlines())
        text = text.replace("scenes:\n", f"scenes:\n  another_{kind}:\n{block}", 1)
    status, output = check(text, tmp_path)
    assert status == 0, output


@pytest.mark.parametrize(("old", "new", "named"), [
    ("elevation: 40", "elevatoin: 40", "elevatoin"),
    ("elevation: 40", "elevation: 400", "400"),
])  # fmt: skip
def test_a_mistake_is_refused_and_named(tmp_path, old, new, named):
    text = SHIPPED.read_text()
    assert old in text
    status, output = check(text.replace(old, new, 1), tmp_path)
    assert status == 1 and named in output
