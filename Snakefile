# The paper's figures. ./reproduce runs this with the options of profiles/default, as a bare snakemake
# does; what is drawn is in config.yaml, one scene a figure. Data go to
# results/<variant>/<stage>_<scene>.nc and figures to results/<variant>/figures/; ./reproduce
# publishes finished ones.
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


wildcard_constraints:
    variant=any_of(VARIANTS),
    scene=any_of(ALL),
    extension="png|svg|pdf",
    number=r"\d{4}",


include: "workflow/rules/results.smk"


rule all:
    default_target: True
    input:
        [behind[-1] for _, behind in paths.figures(VARIANTS).values()],
