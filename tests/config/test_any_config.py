"""Any file named config.yaml either is a correct config or is refused in lines that name it."""

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from project import SHIPPED, shipped
from random_documents import FUZZ, JSON, edited, spoilt

from pipeline import config
from pipeline.config.build_specs import build_specs


@pytest.mark.slow
def test_any_config(tmp_path):
    path = tmp_path / "config.yaml"
    documents = (edited(shipped()) | JSON).map(lambda found: yaml.safe_dump(found).encode())

    @settings(FUZZ, max_examples=100)
    @given(data=documents | spoilt(SHIPPED.read_bytes()) | st.binary(max_size=200))
    def trial(data):
        path.write_bytes(data)
        try:
            checked = config.load(path)
        except config.ConfigError as error:
            assert all(line.startswith("config.yaml: ") for line in str(error).splitlines())
            return
        for result in build_specs(checked, ["paper"]):
            assert (tmp_path / result).resolve().is_relative_to(tmp_path / "results" / "paper")

    trial()
