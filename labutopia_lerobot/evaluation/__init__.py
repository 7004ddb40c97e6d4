"""Playing policies and counting: rollouts, statistics, tables."""
