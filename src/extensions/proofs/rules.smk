# Theorems: certificates that are checked, data and pictures (`./reproduce prove`).
SECONDS |= {
    "results/theorems/theorem_entropy.nc": 16,
    "results/theorems/theorem_curve-six.nc": 10,
    "results/theorems/theorem_curve-fixed-point-outer.nc": 5,
    "results/theorems/theorem_twist-one-zero.nc": 4,
    "results/theorems/theorem_curve-fixed-point-low.nc": 3,
    "results/theorems/derivations_derivations.nc": 3,
}


use rule orbits as theorem with:
    """extensions.proofs.theorems.statements.theorem_verdict"""
    input:
        why=reason("results/{variant}/theorem_{scene}.nc"),
    output:
        **made("results/{variant}/theorem_{scene}.nc"),
    log:
        log_path("results/{variant}/theorem_{scene}.nc"),


use rule orbits as derivations with:
    """extensions.proofs.derivations.derivations"""
    input:
        why=reason("results/{variant}/derivations_{scene}.nc"),
    output:
        **made("results/{variant}/derivations_{scene}.nc"),
    log:
        log_path("results/{variant}/derivations_{scene}.nc"),


use rule orbits as escape with:
    """extensions.proofs.escape.escape"""
    input:
        why=reason("results/{variant}/escape_{scene}.nc"),
    output:
        **made("results/{variant}/escape_{scene}.nc"),
    log:
        log_path("results/{variant}/escape_{scene}.nc"),


use rule orbits as horseshoe with:
    """extensions.proofs.theorems.scenes.scene_horseshoe"""
    input:
        periodic=dataset("periodic"),
        why=reason("results/{variant}/horseshoe_{scene}.nc"),
    output:
        **made("results/{variant}/horseshoe_{scene}.nc"),
    log:
        log_path("results/{variant}/horseshoe_{scene}.nc"),


use rule orbits as twist with:
    """extensions.proofs.theorems.scenes.scene_twist"""
    input:
        why=reason("results/{variant}/twist_{scene}.nc"),
    output:
        **made("results/{variant}/twist_{scene}.nc"),
    log:
        log_path("results/{variant}/twist_{scene}.nc"),


use rule orbits as curves with:
    """extensions.proofs.theorems.scenes.scene_curves"""
    input:
        why=reason("results/{variant}/curves_{scene}.nc"),
    output:
        **made("results/{variant}/curves_{scene}.nc"),
    log:
        log_path("results/{variant}/curves_{scene}.nc"),


use rule orbits as graph with:
    """extensions.proofs.theorems.scenes.scene_graph"""
    input:
        why=reason("results/{variant}/graph_{scene}.nc"),
    output:
        **made("results/{variant}/graph_{scene}.nc"),
    log:
        log_path("results/{variant}/graph_{scene}.nc"),


use rule draw_portrait as draw_horseshoe with:
    """extensions.proofs.figures.horseshoe.draw"""
    input:
        manifolds=dataset("manifolds"),
        horseshoe=dataset("horseshoe"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("horseshoe"),


use rule draw_portrait as draw_twist with:
    """extensions.proofs.figures.twist.draw"""
    input:
        twist=dataset("twist"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("twist"),


use rule draw_portrait as draw_curves with:
    """extensions.proofs.figures.curves.draw"""
    input:
        curves=dataset("curves"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("curves"),


use rule draw_portrait as draw_graph with:
    """extensions.proofs.figures.graph.draw"""
    input:
        graph=dataset("graph"),
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("graph"),


use rule draw_portrait as draw_escape with:
    """extensions.proofs.figures.escape.draw"""
    input:
        escape=dataset("escape"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("escape"),
