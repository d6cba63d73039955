# Accuracy against speed, and where methods fail: `./reproduce study`. No part of the figures needs it.
# Its jobs take every core, one after the other: seconds are measured, and nothing else may run.
from pseudorigid.study import parts


rule study_data:
    input:
        figures=lambda wildcards: study_inputs(wildcards.scene),
        config="config.yaml",
        code=code(
            "study.py",
            "pseudorigid.study.scipy_events",
            "pseudorigid.study.taylor",
            "pseudorigid.study.bench",
        ),
        lock="requirements/study.txt",
    output:
        "results/study/{scene}.nc",
    log:
        "results/study/logs/{scene}.log",
    wildcard_constraints:
        scene="|".join((*parts.FIXED, *parts.MEASURED)),
    conda:
        "../envs/python.yaml"
    threads: workflow.cores
    script:
        "../scripts/study.py"


rule study_chart:
    input:
        data=lambda wildcards: parts.data(parts.CHARTS[wildcards.scene][0]),
        code=code("chart.py"),
    output:
        "results/study/figures/{scene}.png",
    log:
        "results/study/logs/chart_{scene}.log",
    wildcard_constraints:
        scene="|".join(parts.CHARTS),
    conda:
        "../envs/python.yaml"
    script:
        "../scripts/chart.py"


rule study_publish:
    input:
        "results/study/figures/{scene}.png",
    output:
        update("study_figures/{scene}.png"),
    log:
        "results/study/logs/publish_{scene}.log",
    wildcard_constraints:
        scene="|".join(parts.CHARTS),
    conda:
        "../envs/python.yaml"
    shell:
        "(cp {input:q} {input:q}.part && mv -f {input:q}.part {output:q}) 2> {log:q}"


rule study:
    input:
        expand("results/study/{part}.nc", part=(*parts.FIXED, *parts.MEASURED)),
        expand("results/study/figures/{chart}.png", chart=parts.CHARTS),
        expand("study_figures/{chart}.png", chart=parts.CHARTS),
