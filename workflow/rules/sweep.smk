# Sweeps over k and E/g^2, `./reproduce sweep`, and their pictures, `./reproduce atlas`. Cells go in
# blocks, one job on one core each; no part of the paper's figures needs them.


# On a cluster only the blocks are worth a job of their own.
localrules:
    sweep_join,
    atlas_draw,


rule sweep_block:
    input:
        data=inputs("results/sweep/{scene}_{number}.nc"),
    output:
        "results/sweep/{scene}_{number}.nc",
        record="results/sweep/provenance/{scene}_{number}.nc.json",
    log:
        "results/sweep/logs/{scene}_{number}.nc.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
        number=r"\d{4}",
    conda:
        "../envs/python.yaml"
    params:
        block=block("results/sweep/{scene}_{number}.nc"),
        sources=code("results/sweep/{scene}_{number}.nc"),
    script:
        "../scripts/sweep_block.py"


rule sweep_join:
    input:
        data=inputs("results/sweep/{scene}.nc"),
    output:
        "results/sweep/{scene}.nc",
        record="results/sweep/provenance/{scene}.nc.json",
    log:
        "results/sweep/logs/{scene}.nc.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
    conda:
        "../envs/python.yaml"
    params:
        block=block("results/sweep/{scene}.nc"),
        sources=code("results/sweep/{scene}.nc"),
    script:
        "../scripts/sweep_join.py"


rule atlas_draw:
    input:
        data=inputs("results/sweep/figures/{scene}.{extension}"),
    output:
        "results/sweep/figures/{scene}.{extension}",
        record="results/sweep/provenance/{scene}.{extension}.json",
    log:
        "results/sweep/logs/{scene}.{extension}.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
        extension=any_of(places.ATLAS_FORMATS),
    conda:
        "../envs/python.yaml"
    params:
        block=block("results/sweep/figures/{scene}.{extension}"),
        sources=code("results/sweep/figures/{scene}.{extension}"),
    script:
        "../scripts/atlas.py"
