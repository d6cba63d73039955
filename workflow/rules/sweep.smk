# Sweeps over k and E/g^2, `./reproduce sweep`, and their pictures, `./reproduce atlas`. Cells go in
# blocks, one job on one core each; no part of the paper's figures needs them.
from pseudorigid.sweep import grid


# On a cluster only the blocks are worth a job of their own.
localrules:
    sweep_join,
    atlas_draw,
    atlas_publish,
    sweep,
    atlas,


rule sweep_block:
    input:
        code=code("sweep_block.py"),
    output:
        "results/sweep/blocks/{scene}_{number}.nc",
    log:
        "results/sweep/logs/{scene}_{number}.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
        number=r"\d{4}",
    conda:
        "../envs/python.yaml"
    params:
        block=lambda wildcards: grid.block(SWEEPS[wildcards.scene], int(wildcards.number)),
    script:
        "../scripts/sweep_block.py"


rule sweep_join:
    input:
        blocks=lambda wildcards: grid.block_files(wildcards.scene, SWEEPS[wildcards.scene]),
        code=code("sweep_join.py"),
    output:
        "results/sweep/{scene}.nc",
        record="results/sweep/{scene}.nc.sha256",
    log:
        "results/sweep/logs/{scene}.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
    conda:
        "../envs/python.yaml"
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.scene],
    script:
        "../scripts/sweep_join.py"


rule atlas_draw:
    input:
        data="results/sweep/{scene}.nc",
        code=code("atlas.py"),
    output:
        "results/sweep/figures/{scene}.{extension}",
    log:
        "results/sweep/logs/{scene}_{extension}.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
        extension=any_of(grid.FORMATS),
    conda:
        "../envs/python.yaml"
    params:
        sweep=lambda wildcards: SWEEPS[wildcards.scene],
    script:
        "../scripts/atlas.py"


rule atlas_publish:
    input:
        "results/sweep/figures/{scene}.{extension}",
    output:
        update("atlas_figures/{scene}.{extension}"),
    log:
        "results/sweep/logs/publish_{scene}_{extension}.log",
    wildcard_constraints:
        scene=any_of(SWEEPS),
        extension=any_of(grid.FORMATS),
    conda:
        "../envs/python.yaml"
    shell:
        "(cp {input:q} {input:q}.part && mv -f {input:q}.part {output:q}) 2> {log:q}"


rule sweep:
    input:
        [grid.dataset(name) for name in SWEEPS],


rule atlas:
    input:
        [file for name in SWEEPS for file in (grid.dataset(name), *grid.pictures(name, SWEEPS[name]))],
