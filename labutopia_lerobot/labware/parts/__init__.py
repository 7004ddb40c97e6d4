"""Parts of pieces: doors, drawers, buttons, switches, boxes, meshes."""
