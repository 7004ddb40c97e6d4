"""Level 5, beyond the paper: further tasks in which a robot drives."""
