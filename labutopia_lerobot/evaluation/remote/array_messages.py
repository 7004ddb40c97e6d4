"""NumPy arrays in MessagePack, as the servers of openpi send them.

An array is a map of four entries, with binary keys: `__ndarray__` (true), `data` (its bytes),
`dtype` (NumPy's string for it) and `shape`; a scalar is `__npgeneric__`, `data` and `dtype`
(openpi, packages/openpi-client, "msgpack_numpy"). Nothing in such a message can run code.
"""

from typing import Any

import msgpack
import numpy as np

_ARRAY, _SCALAR = b"__ndarray__", b"__npgeneric__"
_NUMBERS = "biufSU"
"""Kinds of element that are sent: numbers, truth values, text."""


def pack(content: Any) -> bytes:
    """Return the message of a value made of maps, lists, text, numbers and arrays."""
    message: bytes = msgpack.packb(content, default=_described)
    return message


def unpack(message: bytes) -> Any:
    """Return what a message holds; arrays cannot be written to.

    Raises:
        ValueError: If it is no such message.
    """
    try:
        return msgpack.unpackb(message, object_hook=_restored)
    except (msgpack.UnpackException, KeyError, TypeError) as error:
        raise ValueError(f"no message of openpi: {error}") from None


def _described(value: Any) -> dict[bytes, Any]:
    if not isinstance(value, np.ndarray | np.generic) or value.dtype.kind not in _NUMBERS:
        raise TypeError(f"{type(value).__name__} cannot be sent")
    dtype = value.dtype.str
    if isinstance(value, np.generic):
        return {_SCALAR: True, b"data": value.item(), b"dtype": dtype}
    return {_ARRAY: True, b"data": value.tobytes(), b"dtype": dtype, b"shape": value.shape}


def _restored(entries: dict[Any, Any]) -> Any:
    if _ARRAY not in entries and _SCALAR not in entries:
        return entries
    dtype = np.dtype(entries[b"dtype"])
    if dtype.kind not in _NUMBERS:
        raise ValueError(f"no message of openpi: elements of type {dtype}")
    if _SCALAR in entries:
        return dtype.type(entries[b"data"])
    return np.frombuffer(entries[b"data"], dtype).reshape(entries[b"shape"])
