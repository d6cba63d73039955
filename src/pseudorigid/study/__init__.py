"""The map against every method it might have been computed with, and where those fail.

`methods` has the methods; `states` the states on which they are compared; `work` what accuracy
costs, `failures` where methods fail, `figure_errors` what that does to each figure, `bench` ratios
of speed. Each asks `proofs.reference_solver` for the first root, which proves it by none of the
methods.

Nothing outside this package imports it, and its libraries come from requirements/study.txt.
"""
