# The stages, a rule each: config and earlier artifacts in, one netCDF file out.
for stage in STAGES:
    result = f"results/{{variant}}/{stage}_{{scene}}.nc"

    rule:
        name:
            stage
        input:
            data=inputs(result),
        output:
            result,
            record=f"results/{{variant}}/provenance/{stage}_{{scene}}.nc.json",
        log:
            f"results/{{variant}}/logs/{stage}_{{scene}}.log",
        wildcard_constraints:
            scene=any_of(name for name, scene in ALL.items() if stage in stages(scene)),
        conda:
            "../envs/python.yaml"
        params:
            block=block(result),
            sources=code(result),
            function=(STAGES[stage].module, STAGES[stage].function),
        script:
            "../scripts/stage.py"
