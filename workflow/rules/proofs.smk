# Theorems: certificates that are checked, data and pictures (`./reproduce prove`).
SECONDS |= {
    "results/claims/theorem_entropy.nc": 16,
    "results/claims/theorem_curve-six.nc": 10,
    "results/claims/theorem_curve-fixed-point-outer.nc": 5,
    "results/claims/theorem_twist-one-zero.nc": 4,
    "results/claims/theorem_curve-fixed-point-low.nc": 3,
    "results/claims/derivations.nc": 3,
}


use rule orbits as theorem with:
    """pseudorigid.proofs.theorems.statements.theorem_verdict"""
    input:
        why=reason("results/claims/theorem_{theorem}.nc"),
    output:
        **made("results/claims/theorem_{theorem}.nc"),
    log:
        log_path("results/claims/theorem_{theorem}.nc"),


use rule orbits as derivations with:
    """pseudorigid.proofs.derivations.derivations"""
    input:
        why=reason("results/claims/derivations.nc"),
    output:
        **made("results/claims/derivations.nc"),
    log:
        log_path("results/claims/derivations.nc"),


use rule orbits as horseshoe with:
    """pseudorigid.proofs.theorems.scenes.scene_horseshoe"""
    input:
        periodic=dataset("periodic"),
        why=reason("results/{variant}/horseshoe_{scene}.nc"),
    output:
        **made("results/{variant}/horseshoe_{scene}.nc"),
    log:
        log_path("results/{variant}/horseshoe_{scene}.nc"),


use rule orbits as twist with:
    """pseudorigid.proofs.theorems.scenes.scene_twist"""
    input:
        why=reason("results/{variant}/twist_{scene}.nc"),
    output:
        **made("results/{variant}/twist_{scene}.nc"),
    log:
        log_path("results/{variant}/twist_{scene}.nc"),


use rule orbits as curves with:
    """pseudorigid.proofs.theorems.scenes.scene_curves"""
    input:
        why=reason("results/{variant}/curves_{scene}.nc"),
    output:
        **made("results/{variant}/curves_{scene}.nc"),
    log:
        log_path("results/{variant}/curves_{scene}.nc"),


use rule orbits as graph with:
    """pseudorigid.proofs.theorems.scenes.scene_graph"""
    input:
        why=reason("results/{variant}/graph_{scene}.nc"),
    output:
        **made("results/{variant}/graph_{scene}.nc"),
    log:
        log_path("results/{variant}/graph_{scene}.nc"),


use rule draw_portrait as draw_horseshoe with:
    """pseudorigid.figures.kinds.horseshoe.draw"""
    input:
        manifolds=dataset("manifolds"),
        horseshoe=dataset("horseshoe"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("horseshoe"),


use rule draw_portrait as draw_twist with:
    """pseudorigid.figures.kinds.twist.draw"""
    input:
        twist=dataset("twist"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("twist"),


use rule draw_portrait as draw_curves with:
    """pseudorigid.figures.kinds.curves.draw"""
    input:
        curves=dataset("curves"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("curves"),


use rule draw_portrait as draw_graph with:
    """pseudorigid.figures.kinds.graph.draw"""
    input:
        graph=dataset("graph"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("graph"),
