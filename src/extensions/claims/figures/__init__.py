"""Pictures behind the verdicts on the paper's statements."""
