"""Draw one chart of the study."""

from job import one_line_errors, recorded
from pipeline.records.artifacts import load
from pipeline.records.drawings import save_figure
from pseudorigid.figures import study

chart = snakemake.params.block
with one_line_errors(snakemake), recorded(snakemake):
    draw = getattr(study, chart["chart"])
    save_figure(draw(load(snakemake.input.data[0]), *chart["arguments"]), snakemake.output[0])
