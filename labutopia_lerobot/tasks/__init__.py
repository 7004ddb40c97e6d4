"""The tasks, one file each: the path is the id."""
