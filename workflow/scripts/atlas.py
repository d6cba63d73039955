"""Draw a sweep: a plane, or a line where k does not vary."""

from job import one_line_errors
from pseudorigid.figures import atlas
from pseudorigid.figures.save import save
from pseudorigid.sweep import grid, store

with one_line_errors(snakemake):
    sweep = snakemake.params.sweep
    data = store.load(snakemake.input.data)
    draw = atlas.line if grid.is_line(sweep) else atlas.plane
    save(draw(sweep, data), snakemake.output[0])
