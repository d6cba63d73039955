# What makes the results, a rule each: the stages, the kinds of picture, the parts of the study
# (`./reproduce study`) and those of the sweeps (`./reproduce sweep` and `atlas`).


# On a cluster only the blocks are worth a job of their own.
localrules:
    sweep_join,
    atlas_draw,


# Seconds on one core. The longest jobs begin first, or the last of them would keep one core busy
# while the others have nothing to do.
SECONDS = {
    "results/claims/spread_spread.nc": 55,
    "results/claims/rotation_rotation.nc": 10,
    "results/claims/flux_flux.nc": 6,
    "results/study/verdicts.nc": 190,
    "results/study/needs.nc": 90,
    "results/study/work_all.nc": 80,
    "results/study/orbits.nc": 35,
    "results/study/edges_all.nc": 20,
}
# result -> the same of it, or of what is made from it.
PRIORITIES = {
    needed: seconds
    for path, seconds in sorted(SECONDS.items(), key=lambda item: item[1])
    if path in EXPECTED
    for needed in expected.needed(EXPECTED, [path])
}
# rule -> (its result, its script, its scenes, what the script is given beside the block of config)
STUDY = "results/study/{scene}.nc"
RULES = {
    name: (
        STUDY,
        "study",
        scenes,
        lambda wildcards: parts.artifacts(wildcards.scene, SCENES, places.served(VARIANTS)),
    )
    for name, scenes in (("study_data", parts.SIDE_BY_SIDE), ("study_alone", parts.ALONE))
} | {
    "study_chart": ("results/study/figures/{scene}.png", "draw", parts.CHARTS, "study"),
    "sweep_block": ("results/sweep/{scene}_{number}.nc", "sweep", SWEEPS, None),
    "sweep_join": ("results/sweep/{scene}.nc", "sweep", SWEEPS, None),
    "atlas_draw": ("results/sweep/figures/{scene}.{extension}", "draw", SWEEPS, "atlas"),
}
for name in STAGES:
    scenes = [scene for scene, block in ALL.items() if name in places.stages(block)]
    result = f"results/{{variant}}/{name}_{{scene}}.nc"
    RULES[name] = result, "stage", scenes, maker(name, result)
for kind in KINDS:
    scenes = [scene for scene, block in ALL.items() if block["picture"] == kind]
    result = "results/{variant}/figures/{scene}.{extension}"
    RULES[f"draw_{kind}"] = result, "draw", scenes, f"kinds.{kind}"

for name, (result, program, scenes, given) in RULES.items():
    _, folder, *_, file = Path(result).parts

    rule:
        name:
            name
        input:
            data=inputs(result),
        output:
            result,
            record=record_path(result),
        log:
            f"results/{folder}/logs/{file}.log",
        wildcard_constraints:
            scene=any_of(scenes),
        priority: priority(result)
        conda:
            "../envs/python.yaml"
        threads: workflow.cores if name == "study_alone" else 1
        params:
            block=made(result, "config"),
            sources=made(result, "sources"),
            given=given,
            program=program,
            workflow=READ,
        script:
            "../scripts/{params.program}.py"
