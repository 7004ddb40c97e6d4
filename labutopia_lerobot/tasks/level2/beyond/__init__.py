"""Level 2, beyond the paper: further short tasks."""
