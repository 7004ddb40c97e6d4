"""The building around a furnished room: walls with holes, doors and windows, floor and ceiling."""
