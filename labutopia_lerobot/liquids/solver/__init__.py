"""Position-based fluid: one call moves particles on, among glass and other shapes."""
