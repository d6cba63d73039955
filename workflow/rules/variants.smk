# Variants: the same rules in folders of their own, without publishing. Which figures exist is known
# once the periodic orbits are.


checkpoint absent:
    input:
        periodic=lambda wildcards: [
            SERVED[wildcards.variant, scene, "periodic"]
            for scene in wanted_orbits(VARIANTS[wildcards.variant])
        ],
        code=code("absent.py"),
    output:
        "results/{variant}/absent.json",
    log:
        "results/{variant}/logs/absent.log",
    conda:
        "../envs/python.yaml"
    params:
        orbits=lambda wildcards: wanted_orbits(VARIANTS[wildcards.variant]),
    script:
        "../scripts/absent.py"


def variant_files(variant):
    """Input function: all figures of a variant that can exist, and the files behind them."""

    def files(wildcards):
        path = checkpoints.absent.get(variant=variant).output[0]
        absent = json.loads(Path(path).read_text(encoding="utf-8"))
        wanted = figures(VARIANTS, variant).items()
        return [path, *with_records({name: made for name, made in wanted if made[0] not in absent})]

    return files


for name in VARIANTS:
    if name != PAPER:

        rule:
            name:
                f"variant_{name}"
            input:
                variant_files(name),
