"""What a dataset says of itself."""

import xarray as xr

from helpers.project import ROOT
from pipeline.config.schema.parts import STAGES

PAGE = "docs/data.md"


def stages_of(package):
    return {name for name, stage in STAGES.items() if stage.function.startswith(package)}


def assert_described(data):
    for name, variable in data.variables.items():
        assert variable.attrs["long_name"], name
        if variable.dtype.kind not in "OUT":
            assert variable.attrs["units"] == "1" and variable.attrs["scale"], name


def assert_describes_itself(file):
    """Its variables do, and the page has what the file says of itself as a whole."""
    with xr.open_dataset(file) as data:
        assert_described(data)
        assert {"title", "config", "source", "references", "k", "g", "energy"} <= set(data.attrs)
        if "row_size" in data:
            dimension = data["row_size"].attrs["sample_dimension"]
            assert data["row_size"].sum() == data.sizes[dimension]
        for attribute in data.attrs:
            assert f"`{attribute}`" in (ROOT / PAGE).read_text(encoding="utf-8"), attribute
        return data.attrs["stage"]
