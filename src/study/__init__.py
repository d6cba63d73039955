"""Comparison of the map with other methods of computing it, and of how these fail.

`methods` has the methods and `states` the states on which they are compared. `work` measures
accuracy and cost, `failures` where methods fail, `figure_errors` what this does to each figure,
and `bench` ratios of speed. `reference_solver` proves the true flight times.

Its libraries are in requirements/study.txt.
"""
