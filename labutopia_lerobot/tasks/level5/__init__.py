"""Level 5: mobile manipulation (paper, "Level 5: Mobile Manipulation Tasks")."""
