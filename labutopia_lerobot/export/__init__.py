"""Pieces, rooms and tasks as files that other programs read: MJCF and OpenUSD."""

from labutopia_lerobot.export.file import SUFFIXES, ExportError, export, require_writable
from labutopia_lerobot.export.subject import Subject, UnknownSubjectError, find_subject

__all__ = [
    "SUFFIXES",
    "ExportError",
    "Subject",
    "UnknownSubjectError",
    "export",
    "find_subject",
    "require_writable",
]
