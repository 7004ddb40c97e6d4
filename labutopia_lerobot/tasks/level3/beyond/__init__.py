"""Level 3, beyond the paper: further tasks that generalise."""
