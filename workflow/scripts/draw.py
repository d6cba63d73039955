"""Draw a picture from its artifacts, by the module of figures that the rule names."""

from importlib import import_module

from pipeline.records.artifacts import load
from pipeline.records.drawings import save_figure
from pipeline.records.job import one_line_errors, recorded

with one_line_errors(snakemake), recorded(snakemake):
    picture = import_module(f"pseudorigid.figures.{snakemake.params.given}")
    data = [load(path) for path in snakemake.input.data]
    save_figure(picture.draw(snakemake.params.block, *data), snakemake.output[0])
