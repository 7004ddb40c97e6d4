"""Level 1, beyond the paper: further atomic manipulation tasks."""
