"""One rule per file: what reacts though no equilibrium says so; what a reaction is called."""
