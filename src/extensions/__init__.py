"""Parts of the pipeline, one folder each; `pipeline.declaration` loads what it finds."""
