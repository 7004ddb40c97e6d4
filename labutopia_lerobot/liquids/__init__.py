"""Liquids: position-based fluid, containment in vessels, coupling, drawing."""
