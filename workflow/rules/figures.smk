# One rule for each kind of picture. The data are handed to the drawing in the order given here.


rule draw_portrait:
    input:
        data=artifacts("orbits"),
        code=code("draw.py", "pseudorigid.figures.kinds.portrait"),
    output:
        reported("portrait"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    log:
        "results/{variant}/logs/draw_{scene}_{extension}.log",
    wildcard_constraints:
        scene=scenes_of("portrait"),
    conda:
        "../envs/python.yaml"
    params:
        scene=drawn_block,
    script:
        "../scripts/draw.py"


use rule draw_portrait as draw_motion with:
    input:
        data=artifacts("motion"),
        code=code("draw.py", "pseudorigid.figures.kinds.motion"),
    output:
        reported("motion"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    wildcard_constraints:
        scene=scenes_of("motion"),


use rule draw_portrait as draw_tangle with:
    input:
        data=artifacts("orbits", "manifolds", "periodic"),
        code=code("draw.py", "pseudorigid.figures.kinds.tangle"),
    output:
        reported("tangle"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    wildcard_constraints:
        scene=scenes_of("tangle"),


use rule draw_portrait as draw_closeup with:
    input:
        data=artifacts("manifolds"),
        code=code("draw.py", "pseudorigid.figures.kinds.closeup"),
    output:
        reported("closeup"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    wildcard_constraints:
        scene=scenes_of("closeup"),


use rule draw_portrait as draw_exponents with:
    input:
        data=artifacts("lyapunov"),
        code=code("draw.py", "pseudorigid.figures.kinds.exponents"),
    output:
        reported("exponents"),
        record="results/{variant}/provenance/{scene}.{extension}.json",
    wildcard_constraints:
        scene=scenes_of("exponents"),
