# Accuracy against speed, and where methods fail: `./reproduce study`. No part of the figures needs it.
# Its jobs take every core, one after the other: seconds are measured, and nothing else may run.


rule study_data:
    input:
        data=inputs("results/study/{scene}.nc"),
    output:
        "results/study/{scene}.nc",
        record="results/study/provenance/{scene}.nc.json",
    log:
        "results/study/logs/{scene}.log",
    wildcard_constraints:
        scene=any_of((*parts.FIXED, *parts.MEASURED)),
    conda:
        "../envs/python.yaml"
    threads: workflow.cores
    params:
        block=block("results/study/{scene}.nc"),
        sources=code("results/study/{scene}.nc"),
        artifacts=lambda wildcards: parts.artifacts(wildcards.scene, SCENES, served(VARIANTS)),
    script:
        "../scripts/study.py"


rule study_chart:
    input:
        data=inputs("results/study/figures/{scene}.png"),
    output:
        "results/study/figures/{scene}.png",
        record="results/study/provenance/{scene}.png.json",
    log:
        "results/study/logs/chart_{scene}.log",
    wildcard_constraints:
        scene=any_of(parts.CHARTS),
    conda:
        "../envs/python.yaml"
    params:
        block=block("results/study/figures/{scene}.png"),
        sources=code("results/study/figures/{scene}.png"),
    script:
        "../scripts/chart.py"
