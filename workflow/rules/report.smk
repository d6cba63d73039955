# What ./reproduce report needs besides the figures, which name their captions themselves.
REPORTED = {name: made for name, made in FIGURES.items() if made[1][-1].endswith(".png")}


rule numbers:
    input:
        results=with_records(REPORTED, published=False),
        code=code("numbers.py"),
    output:
        labels="results/report/labels.json",
        numbers=report(
            "results/report/numbers.html",
            caption="../report/numbers.rst",
            category="Numbers and provenance",
            labels={"table": "numbers: what the paper prints, and what is found here"},
        ),
        provenance=report(
            "results/report/provenance.html",
            caption="../report/provenance.rst",
            category="Numbers and provenance",
            labels={"table": "provenance: what made each result"},
        ),
    log:
        "results/report/logs/numbers.log",
    conda:
        "../envs/python.yaml"
    params:
        scenes=SCENES,
        artifacts={
            scene: {stage: SERVED[PAPER, scene, stage] for stage in stages(block)}
            for scene, block in SCENES.items()
        },
        results=sorted({file for _, behind in REPORTED.values() for file in behind}),
        captions={captions(kind): KINDS[kind].caption for kind in KINDS},
    script:
        "../scripts/numbers.py"


rule report:
    input:
        sorted(behind[-1] for _, behind in REPORTED.values()),
        rules.numbers.output,
