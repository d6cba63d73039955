"""Declarations: fields, kinds of picture, stages, variants, sweeps, and parts of the study."""
