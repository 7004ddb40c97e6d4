"""Level 3, beyond the paper: further generalised tasks."""
