"""What there is: fields, kinds of picture, stages, variants, sweeps, parts of the study."""
