# Data and pictures of the verdicts on the paper's statements (`./reproduce claims`).
SECONDS |= {
    "results/claims/spread_spread.nc": 50,
    "results/claims/rotation_rotation.nc": 8,
    "results/claims/control_control.nc": 8,
    "results/claims/flux_flux.nc": 6,
    "results/claims/clusters_clusters.nc": 25,
    "results/claims/exclusion_exclusion.nc": 15,
    "results/claims/exclusion_exclusion_low.nc": 40,
}


use rule orbits as spread with:
    """extensions.claims.analyses.spread.spread"""
    input:
        why=reason("results/{variant}/spread_{scene}.nc"),
    output:
        **made("results/{variant}/spread_{scene}.nc"),
    log:
        log_path("results/{variant}/spread_{scene}.nc"),


use rule orbits as clusters with:
    """extensions.claims.analyses.clusters.clusters"""
    input:
        why=reason("results/{variant}/clusters_{scene}.nc"),
    output:
        **made("results/{variant}/clusters_{scene}.nc"),
    log:
        log_path("results/{variant}/clusters_{scene}.nc"),


use rule orbits as rotation with:
    """extensions.claims.analyses.rotation.rotation"""
    input:
        why=reason("results/{variant}/rotation_{scene}.nc"),
    output:
        **made("results/{variant}/rotation_{scene}.nc"),
    log:
        log_path("results/{variant}/rotation_{scene}.nc"),


use rule orbits as jumps with:
    """extensions.claims.analyses.jumps.jumps"""
    input:
        why=reason("results/{variant}/jumps_{scene}.nc"),
    output:
        **made("results/{variant}/jumps_{scene}.nc"),
    log:
        log_path("results/{variant}/jumps_{scene}.nc"),


use rule orbits as flux with:
    """extensions.claims.analyses.flux.flux"""
    input:
        why=reason("results/{variant}/flux_{scene}.nc"),
    output:
        **made("results/{variant}/flux_{scene}.nc"),
    log:
        log_path("results/{variant}/flux_{scene}.nc"),


use rule orbits as last_curve with:
    """extensions.atlas.last_curve.last_curve"""
    input:
        why=reason("results/{variant}/last_curve_{scene}.nc"),
    output:
        **made("results/{variant}/last_curve_{scene}.nc"),
    log:
        log_path("results/{variant}/last_curve_{scene}.nc"),


use rule orbits as exclusion with:
    """extensions.claims.analyses.exclusion.exclusion"""
    input:
        why=reason("results/{variant}/exclusion_{scene}.nc"),
    output:
        **made("results/{variant}/exclusion_{scene}.nc"),
    log:
        log_path("results/{variant}/exclusion_{scene}.nc"),


use rule orbits as control with:
    """extensions.claims.analyses.control.control"""
    input:
        why=reason("results/{variant}/control_{scene}.nc"),
    output:
        **made("results/{variant}/control_{scene}.nc"),
    log:
        log_path("results/{variant}/control_{scene}.nc"),


use rule draw_portrait as draw_spread with:
    """extensions.claims.figures.spread.draw"""
    input:
        spread=dataset("spread"),
        lyapunov=dataset("lyapunov"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("spread"),


use rule draw_portrait as draw_clusters with:
    """extensions.claims.figures.clusters.draw"""
    input:
        clusters=dataset("clusters"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("clusters"),


use rule draw_portrait as draw_rotation with:
    """extensions.claims.figures.rotation.draw"""
    input:
        rotation=dataset("rotation"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("rotation"),


use rule draw_portrait as draw_jumps with:
    """extensions.claims.figures.jumps.draw"""
    input:
        jumps=dataset("jumps"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("jumps"),


use rule draw_portrait as draw_flux with:
    """extensions.claims.figures.flux.draw"""
    input:
        flux=dataset("flux"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("flux"),


use rule draw_portrait as draw_last_curve with:
    """extensions.claims.figures.last_curve.draw"""
    input:
        last_curve=dataset("last_curve"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("last_curve"),


use rule draw_portrait as draw_exclusion with:
    """extensions.claims.figures.exclusion.draw"""
    input:
        exclusion=dataset("exclusion"),
        curves=dataset("curves"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("exclusion"),


use rule draw_portrait as draw_control with:
    """extensions.claims.figures.control.draw"""
    input:
        control=dataset("control"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("control"),
