"""Level 4: long-horizon tasks (paper, "Level 4: Long-Horizon Tasks")."""
