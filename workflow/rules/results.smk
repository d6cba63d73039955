# One rule for each stage, each kind of picture, and each part of the study (`./reproduce study`) and
# of the sweeps (`./reproduce sweep` and `atlas`).


# On a cluster, only the blocks run as jobs of their own.
localrules:
    sweep_join,
    atlas_draw,
    chains_draw,


# Seconds on one core. The longest jobs begin first, so that none of them is left over at the end,
# when the other cores are idle.
SECONDS = {
    "results/claims/spread_spread.nc": 50,
    "results/claims/rotation_rotation.nc": 8,
    "results/claims/control_control.nc": 8,
    "results/claims/flux_flux.nc": 6,
    "results/claims/theorem_curve-six.nc": 12,
    "results/claims/theorem_curve-fixed-point-low.nc": 7,
    "results/claims/theorem_curve-fixed-point-outer.nc": 6,
    "results/claims/derivations.nc": 3,
    "results/study/verdicts.nc": 190,
    "results/study/needs.nc": 90,
    "results/study/work_all.nc": 80,
    "results/study/orbits.nc": 35,
    "results/study/edges_all.nc": 20,
}
# Result -> its seconds, or those of the longest job that needs it.
PRIORITIES = {
    dependency: seconds
    for path, seconds in sorted(SECONDS.items(), key=lambda item: item[1])
    if path in PLAN.specs
    for dependency in build_specs.with_dependencies(PLAN.specs, [path])
}
PLANES = [name for name, sweep in SWEEPS.items() if "chains" in sweep]
# Rule -> (its result, its scenes)
STUDY = "results/study/{scene}.nc"
RULES = {
    "study_data": (STUDY, parts.SIDE_BY_SIDE),
    "study_alone": (STUDY, parts.ALONE),
    "study_chart": ("results/study/figures/{scene}.png", parts.CHARTS),
    "sweep_block": ("results/sweep/{scene}_{number}.nc", SWEEPS),
    "sweep_join": ("results/sweep/{scene}.nc", SWEEPS),
    "atlas_draw": ("results/sweep/figures/{scene}.{extension}", SWEEPS),
    "chains": ("results/sweep/{scene}_chains.nc", PLANES),
    "chains_draw": ("results/sweep/figures/{scene}_chains.png", PLANES),
    "derivations": ("results/claims/{scene}.nc", ["derivations"]),
    "theorem": (paths.theorem("{scene}"), paths.THEOREMS),
}
for name in STAGES:
    scenes = [scene for scene, block in ALL.items() if name in paths.stages(block)]
    RULES[name] = f"results/{{variant}}/{name}_{{scene}}.nc", scenes
for kind in KINDS:
    scenes = [scene for scene, block in ALL.items() if block["picture"] == kind]
    RULES[f"draw_{kind}"] = "results/{variant}/figures/{scene}.{extension}", scenes

for name, (result, scenes) in RULES.items():

    rule:
        name:
            name
        input:
            inputs(result),
        output:
            result=update(result),  # not deleted first: the job may find that it is current
            record=update(record_path(result)),
        log:
            log_path(result),
        wildcard_constraints:
            scene=any_of(scenes),
        priority: priority(result)
        conda:
            "../envs/python.yaml"
        threads: workflow.cores if name == "study_alone" else 1
        params:
            python=sys.executable,
            make=ROOT / "workflow" / "scripts" / "make.py",
        shell:
            "{params.python:q} -S {params.make:q} {output.result:q}"
