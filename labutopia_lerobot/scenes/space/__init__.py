"""The room that things take: boxes, what moves out of them, what must stay free, who gets where."""
