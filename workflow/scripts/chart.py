"""Draw one chart of the study."""

from job import one_line_errors
from pseudorigid.artifacts import load
from pseudorigid.figures import study
from pseudorigid.figures.save import save
from pseudorigid.study.parts import CHARTS

with one_line_errors(snakemake):
    _, draw, arguments = CHARTS[snakemake.wildcards.scene]
    save(getattr(study, draw)(load(snakemake.input.data), *arguments), snakemake.output[0])
