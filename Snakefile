# The workflow of the paper's figures. ./reproduce runs it with the options of profiles/default, and
# so does a plain snakemake. config.yaml has one scene for each figure. Data go to
# results/<variant>/<stage>_<scene>.nc and drawings to results/<variant>/figures/, where <variant> may
# also be a set of scenes, as study; ./reproduce publishes the drawings.
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


wildcard_constraints:
    variant=any_of(VARIANTS),
    scene=any_of(ALL),
    extension="png|svg|pdf",
    number=r"\d{4}",


include: "workflow/rules/data.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/study.smk"


# Rules of extensions.
for name in extensions():
    if (EXTENSIONS / name / "rules.smk").is_file():
        try:
            workflow.include(EXTENSIONS / name / "rules.smk")
        except Exception as error:
            sys.exit(f"src/extensions/{name}/rules.smk: {error}")


rule all:
    default_target: True
    input:
        [upstream[-1] for _, upstream in paths.figures(VARIANTS).values()],
