"""Level 3: short manipulation that generalises (paper, "Level 3: Generalizable Short ...")."""
