# Data and pictures of the verdicts on the paper's statements (`./reproduce claims`).
SECONDS |= {
    "results/claims/spread_spread.nc": 50,
    "results/claims/rotation_rotation.nc": 8,
    "results/claims/control_control.nc": 8,
    "results/claims/flux_flux.nc": 6,
}


use rule orbits as spread with:
    """pseudorigid.analyses.spread.spread"""
    input:
        why=reason("results/{variant}/spread_{scene}.nc"),
    output:
        **made("results/{variant}/spread_{scene}.nc"),
    log:
        log_path("results/{variant}/spread_{scene}.nc"),


use rule orbits as clusters with:
    """pseudorigid.analyses.clusters.clusters"""
    input:
        why=reason("results/{variant}/clusters_{scene}.nc"),
    output:
        **made("results/{variant}/clusters_{scene}.nc"),
    log:
        log_path("results/{variant}/clusters_{scene}.nc"),


use rule orbits as rotation with:
    """pseudorigid.analyses.rotation.rotation"""
    input:
        why=reason("results/{variant}/rotation_{scene}.nc"),
    output:
        **made("results/{variant}/rotation_{scene}.nc"),
    log:
        log_path("results/{variant}/rotation_{scene}.nc"),


use rule orbits as jumps with:
    """pseudorigid.analyses.jumps.jumps"""
    input:
        why=reason("results/{variant}/jumps_{scene}.nc"),
    output:
        **made("results/{variant}/jumps_{scene}.nc"),
    log:
        log_path("results/{variant}/jumps_{scene}.nc"),


use rule orbits as flux with:
    """pseudorigid.analyses.flux.flux"""
    input:
        why=reason("results/{variant}/flux_{scene}.nc"),
    output:
        **made("results/{variant}/flux_{scene}.nc"),
    log:
        log_path("results/{variant}/flux_{scene}.nc"),


use rule orbits as last_curve with:
    """pseudorigid.analyses.last_curve.last_curve"""
    input:
        why=reason("results/{variant}/last_curve_{scene}.nc"),
    output:
        **made("results/{variant}/last_curve_{scene}.nc"),
    log:
        log_path("results/{variant}/last_curve_{scene}.nc"),


use rule orbits as escape with:
    """pseudorigid.analyses.escape.escape"""
    input:
        why=reason("results/{variant}/escape_{scene}.nc"),
    output:
        **made("results/{variant}/escape_{scene}.nc"),
    log:
        log_path("results/{variant}/escape_{scene}.nc"),


use rule orbits as control with:
    """pseudorigid.analyses.control.control"""
    input:
        why=reason("results/{variant}/control_{scene}.nc"),
    output:
        **made("results/{variant}/control_{scene}.nc"),
    log:
        log_path("results/{variant}/control_{scene}.nc"),


use rule draw_portrait as draw_spread with:
    """pseudorigid.figures.kinds.spread.draw"""
    input:
        spread=dataset("spread"),
        lyapunov=dataset("lyapunov"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("spread"),


use rule draw_portrait as draw_clusters with:
    """pseudorigid.figures.kinds.clusters.draw"""
    input:
        clusters=dataset("clusters"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("clusters"),


use rule draw_portrait as draw_rotation with:
    """pseudorigid.figures.kinds.rotation.draw"""
    input:
        rotation=dataset("rotation"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("rotation"),


use rule draw_portrait as draw_jumps with:
    """pseudorigid.figures.kinds.jumps.draw"""
    input:
        jumps=dataset("jumps"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("jumps"),


use rule draw_portrait as draw_flux with:
    """pseudorigid.figures.kinds.flux.draw"""
    input:
        flux=dataset("flux"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("flux"),


use rule draw_portrait as draw_last_curve with:
    """pseudorigid.figures.kinds.last_curve.draw"""
    input:
        last_curve=dataset("last_curve"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("last_curve"),


use rule draw_portrait as draw_escape with:
    """pseudorigid.figures.kinds.escape.draw"""
    input:
        escape=dataset("escape"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("escape"),


use rule draw_portrait as draw_control with:
    """pseudorigid.figures.kinds.control.draw"""
    input:
        control=dataset("control"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("control"),
