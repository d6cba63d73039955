# The workflow of the paper's figures. ./reproduce runs it with the options of profiles/default, and
# so does a plain snakemake. config.yaml has one scene for each figure. Data go to
# results/<variant>/<stage>_<scene>.nc and drawings to results/<variant>/figures/, where <variant> may
# also be a set of scenes; ./reproduce publishes the drawings.
from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/common.smk"


wildcard_constraints:
    variant=any_of(VARIANTS),
    scene=any_of(ALL),
    extension="png|svg|pdf|gif",
    number=r"\d{4}",


include: "workflow/rules/paper.smk"


# The rules of all other parts: of each stage, and of each kind of picture.
for declared in other_rules():

    rule:
        name:
            declared.name
        input:
            **declared.inputs,
            why=reason(declared.result),
        output:
            **declared.made,
        log:
            log_path(declared.result),
        wildcard_constraints:
            **declared.constraints,
        priority: priority
        localrule: declared.local
        conda:
            ROOT / "workflow" / "envs" / "python.yaml"
        threads: declared.threads
        params:
            python=sys.executable,
        shell:
            MAKE

    workflow.get_rule(declared.name).docstring = declared.function


rule all:
    default_target: True
    input:
        [drawing for _, drawing in PLAN.config.figures().values()],
