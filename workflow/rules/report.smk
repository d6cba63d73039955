# What ./reproduce report needs besides the figures, which name their captions themselves.
REPORTED = [behind for _, behind in figures(VARIANTS).values() if behind[-1].endswith(".png")]
BEHIND = sorted({file for files in REPORTED for file in files})


rule numbers:
    input:
        results=[*BEHIND, *map(record_path, BEHIND)],
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
            scene: {stage: served(VARIANTS)[PAPER, scene, stage] for stage in stages(scene_block)}
            for scene, scene_block in SCENES.items()
        },
        results=BEHIND,
        captions={captions(kind): KINDS[kind].caption() for kind in KINDS},
    script:
        "../scripts/numbers.py"


rule report:
    input:
        sorted(files[-1] for files in REPORTED),
        rules.numbers.output,
