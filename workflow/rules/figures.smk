# The paper's figures: one rule for each kind of picture, from the datasets of data.smk. All have the
# same output; of_kind names the scenes of a rule: portrait makes Figures 2 and 8, motion 3 and 4,
# tangle 5, closeup 6, exponents 7. From the rule orbits they inherit how a job is run.


use rule orbits as draw_portrait with:
    """pseudorigid.figures.kinds.portrait.draw"""
    input:
        orbits=dataset("orbits"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    output:
        **made(shown("results/{variant}/figures/{scene}.{extension}")),
    log:
        log_path("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("portrait"),


use rule draw_portrait as draw_motion with:
    """pseudorigid.figures.kinds.motion.draw"""
    input:
        motion=dataset("motion"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("motion"),


use rule draw_portrait as draw_tangle with:
    """pseudorigid.figures.kinds.tangle.draw"""
    input:
        orbits=dataset("orbits"),
        manifolds=dataset("manifolds"),
        periodic=dataset("periodic"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("tangle"),


use rule draw_portrait as draw_closeup with:
    """pseudorigid.figures.kinds.closeup.draw"""
    input:
        manifolds=dataset("manifolds"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("closeup"),


use rule draw_portrait as draw_exponents with:
    """pseudorigid.figures.kinds.exponents.draw"""
    input:
        lyapunov=dataset("lyapunov"),
        why=reason("results/{variant}/figures/{scene}.{extension}"),
    wildcard_constraints:
        **of_kind("exponents"),
