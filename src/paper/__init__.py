"""The figures of the paper: their kinds of picture, and the stages that compute their data."""
