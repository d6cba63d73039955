# What makes the results, a rule each: the stages, the kinds of picture, the parts of the study
# (`./reproduce study`) and those of the sweeps (`./reproduce sweep` and `atlas`).


# On a cluster only the blocks are worth a job of their own.
localrules:
    sweep_join,
    atlas_draw,


# rule -> (its result, its script, its scenes, what the script is given beside the block of config)
RULES = {
    "study_data": (
        "results/study/{scene}.nc",
        "study",
        (*parts.FIXED, *parts.MEASURED),
        lambda wildcards: parts.artifacts(wildcards.scene, SCENES, places.served(VARIANTS)),
    ),
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
        conda:
            "../envs/python.yaml"
        # Seconds are measured there, and nothing else may run.
        threads: workflow.cores if name == "study_data" else 1
        params:
            block=made(result, "config"),
            sources=made(result, "sources"),
            given=given,
            program=program,
            workflow=READ,
        script:
            "../scripts/{params.program}.py"
