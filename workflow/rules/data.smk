# Datasets of the paper's figures: one rule for each stage. The docstring of a rule names the function
# that computes the dataset; a scene with a `method` may have another one.
#
# The input dataset("STAGE") is the dataset of another stage of the same scene. The input `why` is a
# file with the reason why the result is outdated; it is no input of a result that is current.
# Records decide that, not times of files (src/pipeline/jobs/plan.py). common.smk has the functions.
#
# A stage serves these stages and pictures (figures.smk):
#     orbits -> draw_portrait, draw_tangle
#     periodic -> motion, manifolds, draw_tangle
#     motion -> draw_motion
#     manifolds -> draw_tangle, draw_closeup
#     lyapunov -> draw_exponents
# The rule orbits is written in full. The other rules inherit what they do not give.


rule orbits:
    """pseudorigid.dynamics.orbits.scene_orbits"""
    input:
        why=reason("results/{variant}/orbits_{scene}.nc"),
    output:
        **made("results/{variant}/orbits_{scene}.nc"),
    log:
        log_path("results/{variant}/orbits_{scene}.nc"),
    priority: priority
    conda:
        ROOT / "workflow" / "envs" / "python.yaml"  # also for rules of extensions
    params:
        python=sys.executable,
        make=ROOT / "workflow" / "scripts" / "make.py",
    shell:
        "{params.python:q} -S {params.make:q} {output.result:q}"


use rule orbits as periodic with:
    """pseudorigid.dynamics.periodic.symmetric_orbits"""
    input:
        why=reason("results/{variant}/periodic_{scene}.nc"),
    output:
        **made("results/{variant}/periodic_{scene}.nc"),
    log:
        log_path("results/{variant}/periodic_{scene}.nc"),


use rule orbits as motion with:
    """pseudorigid.dynamics.motion.scene_motion"""
    input:
        periodic=dataset("periodic"),
        why=reason("results/{variant}/motion_{scene}.nc"),
    output:
        **made("results/{variant}/motion_{scene}.nc"),
    log:
        log_path("results/{variant}/motion_{scene}.nc"),


use rule orbits as manifolds with:
    """pseudorigid.dynamics.manifolds.scene_manifolds"""
    input:
        periodic=dataset("periodic"),
        why=reason("results/{variant}/manifolds_{scene}.nc"),
    output:
        **made("results/{variant}/manifolds_{scene}.nc"),
    log:
        log_path("results/{variant}/manifolds_{scene}.nc"),


use rule orbits as lyapunov with:
    """pseudorigid.dynamics.lyapunov.scene_exponents"""
    input:
        why=reason("results/{variant}/lyapunov_{scene}.nc"),
    output:
        **made("results/{variant}/lyapunov_{scene}.nc"),
    log:
        log_path("results/{variant}/lyapunov_{scene}.nc"),
