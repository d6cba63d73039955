# Sweeps over a grid of k and energy (`./reproduce sweep` and `atlas`): blocks, the dataset that they
# are joined to (results/atlas/sweep_NAME.nc), and pictures; and how reliable their verdicts are.
SECONDS |= {"results/atlas/verdicts.nc": 190}


# On a cluster, only the blocks run as jobs of their own.
localrules:
    sweep,
    draw_atlas,


use rule orbits as sweep_block with:
    """extensions.atlas.cell.block_of_cells_of_a_sweep"""
    input:
        why=reason("results/{variant}/sweep_{scene}.{number}.nc"),
    output:
        **made("results/{variant}/sweep_{scene}.{number}.nc"),
    log:
        log_path("results/{variant}/sweep_{scene}.{number}.nc"),


use rule orbits as sweep with:
    """extensions.atlas.cell.cells_of_a_sweep"""
    input:
        blocks=inputs_of("results/{variant}/sweep_{scene}.nc"),
        why=reason("results/{variant}/sweep_{scene}.nc"),
    output:
        **made("results/{variant}/sweep_{scene}.nc"),
    log:
        log_path("results/{variant}/sweep_{scene}.nc"),


use rule orbits as verdicts with:
    """extensions.atlas.verdicts.verdicts"""
    input:
        why=reason("results/atlas/verdicts.nc"),
    output:
        **made("results/atlas/verdicts.nc"),
    log:
        log_path("results/atlas/verdicts.nc"),
    # It uses all cores, or measures seconds: no other job runs beside it.
    threads: lambda wildcards: workflow.cores


use rule draw_portrait as draw_atlas with:
    """extensions.atlas.figures.atlas.draw"""
    input:
        sweep=dataset("sweep"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("atlas"),


use rule draw_portrait as draw_verdicts with:
    """extensions.atlas.figures.verdicts.draw"""
    input:
        verdicts=dataset("verdicts"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("verdicts"),
