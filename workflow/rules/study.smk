# Accuracy against speed, and where methods fail: `./reproduce study`. No part of the figures needs it.
# Its jobs take every core, one after the other: seconds are measured, and nothing else may run.


rule study_data:
    input:
        figures=lambda wildcards: sorted({f for *_, f in study_artifacts(wildcards.scene)}),
        code=lambda wildcards: study_code(wildcards.scene),
    output:
        "results/study/{scene}.nc",
        record="results/study/provenance/{scene}.nc.json",
    log:
        "results/study/logs/{scene}.log",
    wildcard_constraints:
        scene="|".join((*parts.FIXED, *parts.MEASURED)),
    conda:
        "../envs/python.yaml"
    threads: workflow.cores
    params:
        block=lambda wildcards: parts.block(wildcards.scene, SCENES),
        artifacts=lambda wildcards: study_artifacts(wildcards.scene),
    script:
        "../scripts/study.py"


rule study_chart:
    input:
        data=lambda wildcards: parts.data(parts.CHARTS[wildcards.scene][0]),
        code=code("chart.py"),
    output:
        "results/study/figures/{scene}.png",
        record="results/study/provenance/{scene}.png.json",
    log:
        "results/study/logs/chart_{scene}.log",
    wildcard_constraints:
        scene="|".join(parts.CHARTS),
    conda:
        "../envs/python.yaml"
    params:
        chart=lambda wildcards: parts.drawing(wildcards.scene),
    script:
        "../scripts/chart.py"


rule study_publish:
    input:
        "results/study/figures/{scene}.png",
    output:
        update(parts.FOLDER + "/{scene}.png"),
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
        [parts.data(part) for part in (*parts.FIXED, *parts.MEASURED)],
        [record_path(parts.data(part)) for part in (*parts.FIXED, *parts.MEASURED)],
        [parts.drawn(chart) for chart in parts.CHARTS],
        [record_path(parts.drawn(chart)) for chart in parts.CHARTS],
        [parts.published(chart) for chart in parts.CHARTS],
