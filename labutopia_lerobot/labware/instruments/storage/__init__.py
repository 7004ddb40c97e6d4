"""Storage: cabinets, refrigerators and the like, in which things are kept."""
