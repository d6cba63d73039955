# Families of periodic orbits over a parameter.


use rule orbits as families with:
    """pseudorigid.analyses.families.families"""
    input:
        why=reason("results/{variant}/families_{scene}.nc"),
    output:
        **made("results/{variant}/families_{scene}.nc"),
    log:
        log_path("results/{variant}/families_{scene}.nc"),


use rule orbits as shares with:
    """pseudorigid.sweep.shares.shares"""
    input:
        families=dataset("families"),
        why=reason("results/{variant}/shares_{scene}.nc"),
    output:
        **made("results/{variant}/shares_{scene}.nc"),
    log:
        log_path("results/{variant}/shares_{scene}.nc"),


use rule draw_portrait as draw_families with:
    """pseudorigid.figures.kinds.families.draw"""
    input:
        families=dataset("families"),
        shares=dataset("shares"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        scene=of_kind("families"),
