"""Extensions of the pipeline, one folder each; `pipeline.extensions` loads what it finds."""
