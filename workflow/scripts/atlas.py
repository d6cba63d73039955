"""Draw a sweep: a plane, or a line where k does not vary."""

from job import one_line_errors, save_figure
from pipeline.records import blocks as store
from pseudorigid.figures import atlas
from pseudorigid.sweep import grid

with one_line_errors(snakemake):
    sweep = snakemake.params.sweep
    data = store.load(snakemake.input.data)
    draw = atlas.line if grid.is_line(sweep) else atlas.plane
    save_figure(draw(sweep, data), snakemake.output[0])
