# The kinds of picture, a rule each. The data are handed to `draw` in the order that the kind gives.
for kind in KINDS:
    result = "results/{variant}/figures/{scene}.{extension}"

    rule:
        name:
            f"draw_{kind}"
        input:
            data=inputs(result),
        output:
            reported(result, kind),
            record="results/{variant}/provenance/{scene}.{extension}.json",
        log:
            "results/{variant}/logs/draw_{scene}_{extension}.log",
        wildcard_constraints:
            scene=any_of(name for name, scene in ALL.items() if scene["picture"] == kind),
        conda:
            "../envs/python.yaml"
        params:
            block=block(result),
            sources=code(result),
        script:
            "../scripts/draw.py"
