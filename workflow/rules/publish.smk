# The only rule that touches paper_figures/, and only with a finished file. update() keeps snakemake
# from deleting the committed figure first; the rename replaces it in one step.


rule publish:
    input:
        "results/paper/figures/{scene}.{extension}",
    output:
        update("paper_figures/{scene}.{extension}"),
    log:
        "results/paper/logs/publish_{scene}_{extension}.log",
    conda:
        "../envs/python.yaml"
    shell:
        "(cp {input:q} {input:q}.part && mv -f {input:q}.part {output:q}) 2> {log:q}"
