"""Searches in floating point: they propose certificates, and prove nothing.

They use the checkers' formulas, for their midpoints, and the dynamics. No checker uses a search.
The argument `theorem` is the `theorems.statements.Theorem` that the certificate is to prove.
"""
