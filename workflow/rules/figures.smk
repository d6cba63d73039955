# The kinds of picture, a rule each. The data are handed to `draw` in the order that the kind gives.
for kind in KINDS:

    rule:
        name:
            f"draw_{kind}"
        input:
            data=artifacts(*KINDS[kind].stages),
            code=[*drawing_code(kind), LOCK],
        output:
            reported(kind),
            record="results/{variant}/provenance/{scene}.{extension}.json",
        log:
            "results/{variant}/logs/draw_{scene}_{extension}.log",
        wildcard_constraints:
            scene=scenes_of(kind),
        conda:
            "../envs/python.yaml"
        params:
            scene=drawn_block,
        script:
            "../scripts/draw.py"
