# The study of speed against accuracy (`./reproduce study`): one rule for each dataset, then one for
# each kind of chart. Names that end with _all are measurements, which differ between machines.
SECONDS |= {
    "results/study/verdicts.nc": 190,
    "results/study/needs.nc": 90,
    "results/study/work_all.nc": 80,
    "results/study/orbits.nc": 35,
    "results/study/edges_all.nc": 20,
}


use rule orbits as study_work with:
    """pseudorigid.study.work.counted"""
    input:
        why=reason("results/study/work.nc"),
    output:
        **made("results/study/work.nc"),
    log:
        log_path("results/study/work.nc"),


use rule orbits as study_edges with:
    """pseudorigid.study.failures.edges"""
    input:
        why=reason("results/study/edges.nc"),
    output:
        **made("results/study/edges.nc"),
    log:
        log_path("results/study/edges.nc"),


use rule orbits as study_orbits with:
    """pseudorigid.study.failures.orbits"""
    input:
        why=reason("results/study/orbits.nc"),
    output:
        **made("results/study/orbits.nc"),
    log:
        log_path("results/study/orbits.nc"),


use rule orbits as study_needs with:
    """pseudorigid.study.figure_errors.figure_errors"""
    input:
        periodic=of_figures("periodic"),
        manifolds=of_figures("manifolds"),
        why=reason("results/study/needs.nc"),
    output:
        **made("results/study/needs.nc"),
    log:
        log_path("results/study/needs.nc"),


use rule orbits as study_verdicts with:
    """pseudorigid.study.verdicts.verdicts"""
    input:
        why=reason("results/study/verdicts.nc"),
    output:
        **made("results/study/verdicts.nc"),
    log:
        log_path("results/study/verdicts.nc"),
    # It uses all cores, or measures seconds: no other job runs beside it.
    threads: lambda wildcards: workflow.cores


use rule orbits as study_work_all with:
    """pseudorigid.study.work.measured"""
    input:
        why=reason("results/study/work_all.nc"),
    output:
        **made("results/study/work_all.nc"),
    log:
        log_path("results/study/work_all.nc"),
    # It uses all cores, or measures seconds: no other job runs beside it.
    threads: lambda wildcards: workflow.cores


use rule orbits as study_edges_all with:
    """pseudorigid.study.failures.edges"""
    input:
        why=reason("results/study/edges_all.nc"),
    output:
        **made("results/study/edges_all.nc"),
    log:
        log_path("results/study/edges_all.nc"),


use rule orbits as study_missed_all with:
    """pseudorigid.study.failures.missed"""
    input:
        why=reason("results/study/missed_all.nc"),
    output:
        **made("results/study/missed_all.nc"),
    log:
        log_path("results/study/missed_all.nc"),


use rule orbits as draw_study_work with:
    """pseudorigid.figures.study.work"""
    input:
        work="results/study/work.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    output:
        **made("results/study/figures/{chart}.{extension}"),
    log:
        log_path("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="work_(uniform|grazing)",


use rule draw_study_work as draw_study_work_all with:
    """pseudorigid.figures.study.work"""
    input:
        work_all="results/study/work_all.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="(work_all|seconds)_(uniform|grazing)",


use rule draw_study_work as draw_study_edges with:
    """pseudorigid.figures.study.edges"""
    input:
        edges="results/study/edges.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="edges",


use rule draw_study_work as draw_study_edges_all with:
    """pseudorigid.figures.study.edges"""
    input:
        edges_all="results/study/edges_all.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="edges_all",


use rule draw_study_work as draw_study_energy with:
    """pseudorigid.figures.study.energy"""
    input:
        orbits="results/study/orbits.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="energy",


use rule draw_study_work as draw_study_separation with:
    """pseudorigid.figures.study.separation"""
    input:
        orbits="results/study/orbits.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="apart",


use rule draw_study_work as draw_study_figure_errors with:
    """pseudorigid.figures.study.figure_errors"""
    input:
        needs="results/study/needs.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="needs",


use rule draw_study_work as draw_study_verdicts with:
    """pseudorigid.figures.study.verdicts"""
    input:
        verdicts="results/study/verdicts.nc",
        why=reason("results/study/figures/{chart}.{extension}"),
    wildcard_constraints:
        chart="verdicts",
