# Sweeps over a grid of k and energy (`./reproduce sweep` and `atlas`): blocks, the dataset that they
# are joined to, pictures, and curves of chains over a plane.


# On a cluster, only the blocks run as jobs of their own.
localrules:
    sweep_join,
    atlas_draw,
    chains_draw,


use rule orbits as sweep_block with:
    """pseudorigid.sweep.blocks.compute"""
    input:
        why=reason("results/sweep/{sweep}_{number}.nc"),
    output:
        **made("results/sweep/{sweep}_{number}.nc"),
    log:
        log_path("results/sweep/{sweep}_{number}.nc"),


use rule orbits as sweep_join with:
    """pseudorigid.sweep.blocks.join"""
    input:
        blocks=lambda wildcards: paths.block_files(wildcards.sweep, SWEEPS[wildcards.sweep]),
        why=reason("results/sweep/{sweep}.nc"),
    output:
        **made("results/sweep/{sweep}.nc"),
    log:
        log_path("results/sweep/{sweep}.nc"),


use rule orbits as atlas_draw with:
    """pseudorigid.figures.atlas.draw"""
    input:
        data="results/sweep/{sweep}.nc",
        why=reason("results/sweep/figures/{sweep}.{extension}"),
    output:
        **made("results/sweep/figures/{sweep}.{extension}"),
    log:
        log_path("results/sweep/figures/{sweep}.{extension}"),


use rule orbits as chains with:
    """pseudorigid.sweep.chains.chains"""
    input:
        why=reason("results/sweep/{sweep}_chains.nc"),
    output:
        **made("results/sweep/{sweep}_chains.nc"),
    log:
        log_path("results/sweep/{sweep}_chains.nc"),


use rule orbits as chains_draw with:
    """pseudorigid.figures.chains.draw"""
    input:
        data="results/sweep/{sweep}.nc",
        chains="results/sweep/{sweep}_chains.nc",
        why=reason("results/sweep/figures/{sweep}_chains.png"),
    output:
        **made("results/sweep/figures/{sweep}_chains.png"),
    log:
        log_path("results/sweep/figures/{sweep}_chains.png"),
