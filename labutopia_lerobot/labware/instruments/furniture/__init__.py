"""Benches, tables, cupboards, shelves: what a laboratory is furnished with."""
