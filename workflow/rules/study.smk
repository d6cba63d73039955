# The study of speed against accuracy (`./reproduce study`): one rule for each dataset, then one for
# each kind of chart. Stages that end with _all are measurements, which differ between machines.
SECONDS |= {
    "results/study/needs.nc": 90,
    "results/study/work_all.nc": 80,
    "results/study/drift.nc": 35,
    "results/study/edges_all.nc": 20,
}


use rule orbits as work with:
    """study.stages.work"""
    input:
        why=reason("results/study/work.nc"),
    output:
        **made("results/study/work.nc"),
    log:
        log_path("results/study/work.nc"),


use rule orbits as edges with:
    """study.stages.edges"""
    input:
        why=reason("results/study/edges.nc"),
    output:
        **made("results/study/edges.nc"),
    log:
        log_path("results/study/edges.nc"),


use rule orbits as drift with:
    """study.stages.drift"""
    input:
        why=reason("results/study/drift.nc"),
    output:
        **made("results/study/drift.nc"),
    log:
        log_path("results/study/drift.nc"),


use rule orbits as needs with:
    """study.figure_errors.figure_errors"""
    input:
        datasets=inputs_of("results/study/needs.nc"),
        why=reason("results/study/needs.nc"),
    output:
        **made("results/study/needs.nc"),
    log:
        log_path("results/study/needs.nc"),


use rule orbits as work_all with:
    """study.measured.work_all"""
    input:
        why=reason("results/study/work_all.nc"),
    output:
        **made("results/study/work_all.nc"),
    log:
        log_path("results/study/work_all.nc"),
    # It uses all cores, or measures seconds: no other job runs beside it.
    threads: lambda wildcards: workflow.cores


use rule orbits as edges_all with:
    """study.measured.edges_all"""
    input:
        why=reason("results/study/edges_all.nc"),
    output:
        **made("results/study/edges_all.nc"),
    log:
        log_path("results/study/edges_all.nc"),


use rule orbits as missed_all with:
    """study.measured.missed_all"""
    input:
        why=reason("results/study/missed_all.nc"),
    output:
        **made("results/study/missed_all.nc"),
    log:
        log_path("results/study/missed_all.nc"),


use rule draw_portrait as draw_work with:
    """study.charts.work"""
    input:
        work=dataset("work"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("work"),


use rule draw_portrait as draw_measured_work with:
    """study.charts.work"""
    input:
        work_all=dataset("work_all"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("measured_work"),


use rule draw_portrait as draw_edges with:
    """study.charts.edges"""
    input:
        edges=dataset("edges"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("edges"),


use rule draw_portrait as draw_measured_edges with:
    """study.charts.edges"""
    input:
        edges_all=dataset("edges_all"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("measured_edges"),


use rule draw_portrait as draw_energy with:
    """study.charts.energy"""
    input:
        drift=dataset("drift"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("energy"),


use rule draw_portrait as draw_separation with:
    """study.charts.separation"""
    input:
        drift=dataset("drift"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("separation"),


use rule draw_portrait as draw_figure_errors with:
    """study.charts.figure_errors"""
    input:
        needs=dataset("needs"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("figure_errors"),
