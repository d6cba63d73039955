"""The stages behind the verdicts on the paper's statements, and what they share."""
