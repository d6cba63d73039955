# Families of periodic orbits over a parameter, and chains of islands over the plane of a sweep.


# On a cluster, this drawing is no job of its own.
localrules:
    draw_chains,


use rule orbits as families with:
    """extensions.families.families.families"""
    input:
        why=reason("results/{variant}/families_{scene}.nc"),
    output:
        **made("results/{variant}/families_{scene}.nc"),
    log:
        log_path("results/{variant}/families_{scene}.nc"),


use rule orbits as shares with:
    """extensions.families.shares.shares"""
    input:
        families=dataset("families"),
        why=reason("results/{variant}/shares_{scene}.nc"),
    output:
        **made("results/{variant}/shares_{scene}.nc"),
    log:
        log_path("results/{variant}/shares_{scene}.nc"),


use rule draw_portrait as draw_families with:
    """extensions.families.figures.families.draw"""
    input:
        families=dataset("families"),
        shares=dataset("shares"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("families"),


use rule orbits as chains with:
    """extensions.families.chains.chains"""
    input:
        why=reason("results/{variant}/chains_{scene}.nc"),
    output:
        **made("results/{variant}/chains_{scene}.nc"),
    log:
        log_path("results/{variant}/chains_{scene}.nc"),


use rule draw_portrait as draw_chains with:
    """extensions.families.figures.chains.draw"""
    input:
        sweep=dataset("sweep"),
        chains=dataset("chains"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("chains"),
