"""What the scripts share: one line for a job that cannot be done, and the saving of a stage."""

import sys
import traceback
from contextlib import contextmanager


def _uncaught(kind, error, trace):
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _uncaught  # Ctrl-C is no reason for a traceback


@contextmanager
def one_line_errors(snakemake):
    """Turn an error into one line on stderr and exit status 1; the job's log has its traceback."""
    log = snakemake.log[0]
    try:
        yield
    except Exception as error:
        message = " ".join(str(error).split())
        if not isinstance(error, ValueError):  # ValueErrors are written for the user
            message = f"{type(error).__name__}: {message} (traceback in {log})"
        message = f"pseudorigid: {snakemake.wildcards.scene}: {message}"
        with open(log, "w", encoding="utf-8") as file:
            file.write(f"{traceback.format_exc()}\n{message}\n")
        print(message, file=sys.stderr)
        sys.exit(1)


@contextmanager
def recorded(snakemake, config):
    """Write the record of what made the output, `config` being the block behind it."""
    from pseudorigid import provenance

    sources = [path for path in snakemake.input.code if path.endswith(".py")]
    inputs = set(snakemake.input) - set(snakemake.input.code)
    record = provenance.begin(config=config, inputs=inputs, sources=sources)
    yield
    provenance.finish(record, snakemake.output[0], snakemake.output.record)


def save_stage(snakemake, compute):
    """Save what `compute(ball, energy, **fields of the stage's block)` returns."""
    from pseudorigid import artifacts
    from pseudorigid.ball import Ball

    block = snakemake.params.block
    with one_line_errors(snakemake), recorded(snakemake, block):
        fields = {key: value for key, value in block.items() if key not in ("ball", "energy")}
        ball = Ball(**block["ball"])
        dataset = compute(ball, block["energy"], **fields)
        artifacts.save(
            dataset,
            snakemake.output[0],
            stage=snakemake.rule,
            ball=ball,
            energy=block["energy"],
            config=block,
        )
