"""Comparison of the map with other methods of computing it, and of how these fail.

`methods` has the methods and `states` the states on which they are compared. `stages` compares
accuracy and failures, `figure_errors` the figures, and
`bench` ratios of speed. True flight times are those that `pseudorigid.verified` proves.

Its libraries are in requirements/study.txt.
"""
