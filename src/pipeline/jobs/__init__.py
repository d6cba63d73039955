"""The jobs of a run: each makes one result, as its build specification says."""
