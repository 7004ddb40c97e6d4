"""Level 1: atomic manipulation (paper, "Level 1: Atomic Manipulation Tasks")."""
