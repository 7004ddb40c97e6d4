"""Level 2: short-horizon manipulation (paper, "Level 2: Short-Horizon Manipulation Tasks")."""
