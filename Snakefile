# The paper's figures. ./reproduce runs this with the profile workflow/profiles/default; what is
# drawn is in config.yaml, one scene a figure. Data go to results/<variant>/<stage>_<scene>.nc,
# figures to results/<variant>/figures/, and finished figures from there to paper_figures/.
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


wildcard_constraints:
    variant="paper",
    scene="|".join(SCENES),
    extension="png|svg|pdf",


include: "workflow/rules/compute.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/publish.smk"
include: "workflow/rules/study.smk"
include: "workflow/rules/sweep.smk"


# Every file by name, also those on the way: one that was deleted comes back.
rule all:
    default_target: True
    input:
        sorted(FIGURES),
        sorted({file for _, behind in FIGURES.values() for file in behind}),
        sorted({record_path(file) for _, behind in FIGURES.values() for file in behind}),
