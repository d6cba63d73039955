# The stages: config and earlier artifacts in, one netCDF file out.


rule orbits:
    input:
        code=code("orbits.py"),
    output:
        "results/{variant}/orbits_{scene}.nc",
        record="results/{variant}/provenance/orbits_{scene}.nc.json",
    log:
        "results/{variant}/logs/orbits_{scene}.log",
    wildcard_constraints:
        scene=scenes_with("orbits"),
    conda:
        "../envs/python.yaml"
    params:
        block=stage_block("orbits"),
    script:
        "../scripts/orbits.py"


rule periodic:
    input:
        code=code("periodic.py"),
    output:
        "results/{variant}/periodic_{scene}.nc",
        record="results/{variant}/provenance/periodic_{scene}.nc.json",
    log:
        "results/{variant}/logs/periodic_{scene}.log",
    wildcard_constraints:
        scene=scenes_with("periodic"),
    conda:
        "../envs/python.yaml"
    params:
        block=stage_block("periodic"),
    script:
        "../scripts/periodic.py"


rule motion:
    input:
        periodic=artifacts("periodic"),
        code=code("motion.py"),
    output:
        "results/{variant}/motion_{scene}.nc",
        record="results/{variant}/provenance/motion_{scene}.nc.json",
    log:
        "results/{variant}/logs/motion_{scene}.log",
    wildcard_constraints:
        scene=scenes_with("motion"),
    conda:
        "../envs/python.yaml"
    params:
        block=stage_block("motion"),
    script:
        "../scripts/motion.py"


rule manifolds:
    input:
        periodic=artifacts("periodic"),
        code=code("manifolds.py"),
    output:
        "results/{variant}/manifolds_{scene}.nc",
        record="results/{variant}/provenance/manifolds_{scene}.nc.json",
    log:
        "results/{variant}/logs/manifolds_{scene}.log",
    wildcard_constraints:
        scene=scenes_with("manifolds"),
    conda:
        "../envs/python.yaml"
    params:
        block=stage_block("manifolds"),
    script:
        "../scripts/manifolds.py"


rule lyapunov:
    input:
        code=code("lyapunov.py"),
    output:
        "results/{variant}/lyapunov_{scene}.nc",
        record="results/{variant}/provenance/lyapunov_{scene}.nc.json",
    log:
        "results/{variant}/logs/lyapunov_{scene}.log",
    wildcard_constraints:
        scene=scenes_with("lyapunov"),
    conda:
        "../envs/python.yaml"
    params:
        block=stage_block("lyapunov"),
    script:
        "../scripts/lyapunov.py"
