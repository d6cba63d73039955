"""Declarations: fields, kinds of picture, stages, sets of scenes and variants."""
