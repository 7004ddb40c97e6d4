"""Stands, tripods and racks."""
