"""What pieces are made of: doors, drawers, buttons, switches, boxes, meshes."""
