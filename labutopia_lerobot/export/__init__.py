"""Pieces, rooms and tasks as files that other programs read: MJCF and OpenUSD."""

from labutopia_lerobot.export.file import SUFFIXES, ExportError, export, require_writable
from labutopia_lerobot.export.subject import ExportSubject, UnknownSubjectError, find_subject

__all__ = [
    "SUFFIXES",
    "ExportError",
    "ExportSubject",
    "UnknownSubjectError",
    "export",
    "find_subject",
    "require_writable",
]
