"""What the expert can do: finite-state machines made of phases that end on conditions."""
