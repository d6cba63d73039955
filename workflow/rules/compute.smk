# The stages, a rule each: config and earlier artifacts in, one netCDF file out.
for stage in STAGES:

    rule:
        name:
            stage
        input:
            data=artifacts(*STAGES[stage].inputs),
            code=[*stage_code(stage), LOCK],
        output:
            f"results/{{variant}}/{stage}_{{scene}}.nc",
            record=f"results/{{variant}}/provenance/{stage}_{{scene}}.nc.json",
        log:
            f"results/{{variant}}/logs/{stage}_{{scene}}.log",
        wildcard_constraints:
            scene=scenes_with(stage),
        conda:
            "../envs/python.yaml"
        params:
            block=stage_block(stage),
            function=(STAGES[stage].module, STAGES[stage].function),
        script:
            "../scripts/stage.py"
