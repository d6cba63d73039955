"""Draw one chart of the study."""

from job import one_line_errors, recorded, save_figure
from pipeline.config.study import CHARTS, drawing
from pipeline.records.artifacts import load
from pseudorigid.figures import study

chart = snakemake.wildcards.scene
with one_line_errors(snakemake), recorded(snakemake, drawing(chart)):
    _, draw, arguments = CHARTS[chart]
    save_figure(getattr(study, draw)(load(snakemake.input.data), *arguments), snakemake.output[0])
