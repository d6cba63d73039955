# The chain of Figures 2-8. Written by .venv/bin/python -m pipeline.renew from src/paper/.
#
# The docstring of a rule names the function that its job calls; a scene with a `method` may have
# another one. dataset("STAGE") is the dataset of a stage of the same scene, which variants share. A
# result is made if its specification is newer (common.smk).


rule orbits:
    """pseudorigid.dynamics.orbits.scene_orbits"""
    input:
        specification="results/{variant}/specs/orbits_{scene}.nc.json",
    output:
        result="results/{variant}/orbits_{scene}.nc",
        record="results/{variant}/provenance/orbits_{scene}.nc.json",
    log:
        "results/{variant}/logs/orbits_{scene}.nc.log",
    resources:
        mem_mb=500,
        runtime=10,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule periodic:
    """pseudorigid.dynamics.periodic.symmetric_orbits"""
    input:
        specification="results/{variant}/specs/periodic_{scene}.nc.json",
    output:
        result="results/{variant}/periodic_{scene}.nc",
        record="results/{variant}/provenance/periodic_{scene}.nc.json",
    log:
        "results/{variant}/logs/periodic_{scene}.nc.log",
    resources:
        mem_mb=500,
        runtime=10,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule motion:
    """pseudorigid.dynamics.motion.scene_motion"""
    input:
        specification="results/{variant}/specs/motion_{scene}.nc.json",
        periodic=dataset("periodic"),
    output:
        result="results/{variant}/motion_{scene}.nc",
        record="results/{variant}/provenance/motion_{scene}.nc.json",
    log:
        "results/{variant}/logs/motion_{scene}.nc.log",
    resources:
        mem_mb=500,
        runtime=10,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule manifolds:
    """pseudorigid.dynamics.manifolds.scene_manifolds"""
    input:
        specification="results/{variant}/specs/manifolds_{scene}.nc.json",
        periodic=dataset("periodic"),
    output:
        result="results/{variant}/manifolds_{scene}.nc",
        record="results/{variant}/provenance/manifolds_{scene}.nc.json",
    log:
        "results/{variant}/logs/manifolds_{scene}.nc.log",
    resources:
        mem_mb=500,
        runtime=10,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule lyapunov:
    """pseudorigid.dynamics.lyapunov.scene_exponents"""
    input:
        specification="results/{variant}/specs/lyapunov_{scene}.nc.json",
    output:
        result="results/{variant}/lyapunov_{scene}.nc",
        record="results/{variant}/provenance/lyapunov_{scene}.nc.json",
    log:
        "results/{variant}/logs/lyapunov_{scene}.nc.log",
    resources:
        mem_mb=500,
        runtime=10,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule draw_portrait:
    """paper.figures.portrait.draw"""
    input:
        specification="results/{variant}/specs/{scene}.{extension}.json",
        orbits=dataset("orbits"),
    output:
        result=shown("results/{variant}/figures/{scene}.{extension}"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/{scene}.{extension}.log",
    wildcard_constraints:
        **of_kind("portrait"),
    resources:
        mem_mb=1000,
        runtime=60,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule draw_motion:
    """paper.figures.motion.draw"""
    input:
        specification="results/{variant}/specs/{scene}.{extension}.json",
        motion=dataset("motion"),
    output:
        result=shown("results/{variant}/figures/{scene}.{extension}"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/{scene}.{extension}.log",
    wildcard_constraints:
        **of_kind("motion"),
    resources:
        mem_mb=1000,
        runtime=60,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule draw_tangle:
    """paper.figures.tangle.draw"""
    input:
        specification="results/{variant}/specs/{scene}.{extension}.json",
        orbits=dataset("orbits"),
        manifolds=dataset("manifolds"),
        periodic=dataset("periodic"),
    output:
        result=shown("results/{variant}/figures/{scene}.{extension}"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/{scene}.{extension}.log",
    wildcard_constraints:
        **of_kind("tangle"),
    resources:
        mem_mb=1000,
        runtime=60,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule draw_closeup:
    """paper.figures.closeup.draw"""
    input:
        specification="results/{variant}/specs/{scene}.{extension}.json",
        manifolds=dataset("manifolds"),
    output:
        result=shown("results/{variant}/figures/{scene}.{extension}"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/{scene}.{extension}.log",
    wildcard_constraints:
        **of_kind("closeup"),
    resources:
        mem_mb=1000,
        runtime=60,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"


rule draw_exponents:
    """paper.figures.exponents.draw"""
    input:
        specification="results/{variant}/specs/{scene}.{extension}.json",
        lyapunov=dataset("lyapunov"),
    output:
        result=shown("results/{variant}/figures/{scene}.{extension}"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/{scene}.{extension}.log",
    wildcard_constraints:
        **of_kind("exponents"),
    resources:
        mem_mb=1000,
        runtime=60,
    shell:
        "python -P -m pipeline.jobs.job {input.specification}"
