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


# The rules of all other parts: one for each stage, and one for each kind of picture.
for name, function, result, inputs in other_rules():
    drawing = name.startswith("draw_")

    rule:
        name:
            name
        input:
            **inputs,
            specification=spec_path(result),
        output:
            result=shown(result) if drawing else result,
            record=record_path(result),
        log:
            log_path(result),
        wildcard_constraints:
            **(of_kind(name.removeprefix("draw_")) if drawing else {}),
        priority: priority
        localrule: name in JOINED
        threads: (lambda wildcards: workflow.cores) if name in ALONE else 1
        resources:
            **resources_of(name),
        shell:
            "python -P -m pipeline.jobs.job {input.specification}"

    workflow.get_rule(name).docstring = function


rule all:
    default_target: True
    input:
        [drawing for _, drawing in CONFIG.figures().values()],
