"""Draw a sweep: a plane, or a line where k does not vary."""

from job import one_line_errors, recorded
from pipeline.records.artifacts import load
from pipeline.records.drawings import save_figure
from pseudorigid.figures import atlas
from pseudorigid.sweep import grid

with one_line_errors(snakemake), recorded(snakemake):
    sweep = snakemake.params.block
    draw = atlas.line if grid.is_line(sweep) else atlas.plane
    save_figure(draw(sweep, load(snakemake.input.data[0])), snakemake.output[0])
