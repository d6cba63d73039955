"""Jobs: each makes one result, as its build specification says."""
