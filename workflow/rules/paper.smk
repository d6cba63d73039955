# The chain of the paper's figures: one rule for each stage, then one for each kind of picture. The
# docstring of a rule names its function; a scene with a `method` may have another one.
#
# The input dataset("STAGE") is the dataset of another stage of the same scene. The input `why` is a
# file with the reason why the result is outdated; it is no input of a result that is current.
# Records decide that, not times of files (src/pipeline/jobs/plan.py). common.smk has the functions.
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
        ROOT / "workflow" / "envs" / "python.yaml"
    params:
        python=sys.executable,
    shell:
        MAKE


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


# The figures. All rules have the same output; of_kind names the scenes of a rule: portrait makes
# Figures 2 and 8, motion 3 and 4, tangle 5, closeup 6, exponents 7.


use rule orbits as draw_portrait with:
    """paper.figures.portrait.draw"""
    input:
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    output:
        **made(shown("results/{variant}/figures/{scene}.{extension}")),
    log:
        log_path("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("portrait"),


use rule draw_portrait as draw_motion with:
    """paper.figures.motion.draw"""
    input:
        motion=dataset("motion"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("motion"),


use rule draw_portrait as draw_tangle with:
    """paper.figures.tangle.draw"""
    input:
        orbits=dataset("orbits"),
        manifolds=dataset("manifolds"),
        periodic=dataset("periodic"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("tangle"),


use rule draw_portrait as draw_closeup with:
    """paper.figures.closeup.draw"""
    input:
        manifolds=dataset("manifolds"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("closeup"),


use rule draw_portrait as draw_exponents with:
    """paper.figures.exponents.draw"""
    input:
        lyapunov=dataset("lyapunov"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("exponents"),
