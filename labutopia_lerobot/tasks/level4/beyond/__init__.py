"""Level 4, beyond the paper: further long-horizon manipulation tasks."""
