"""Draw a scene from its artifacts; the kind of picture names the module that does it."""

from importlib import import_module

from job import one_line_errors, recorded
from pipeline.records.artifacts import load
from pipeline.records.drawings import save_figure

scene = snakemake.params.block
with one_line_errors(snakemake), recorded(snakemake):
    picture = import_module(f"pseudorigid.figures.kinds.{scene['picture']}")
    data = [load(path) for path in snakemake.input.data]
    save_figure(picture.draw(scene, *data), snakemake.output[0])
