"""Draw one chart of the study."""

from job import one_line_errors, recorded
from pseudorigid.artifacts import load
from pseudorigid.figures import study
from pseudorigid.figures.save import save
from pseudorigid.study.parts import CHARTS, drawing

chart = snakemake.wildcards.scene
with one_line_errors(snakemake), recorded(snakemake, drawing(chart)):
    _, draw, arguments = CHARTS[chart]
    save(getattr(study, draw)(load(snakemake.input.data), *arguments), snakemake.output[0])
