"""Analyses behind the verdicts on the statements of the paper, one stage in each module."""
