"""Compiling kernels with numba, once per machine."""

import hashlib
import logging
import os
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from pathlib import Path
from typing import Any, cast

_SOURCES = Path(__file__).parent
_DIGEST = _SOURCES / "__pycache__" / "kernels.sha256"


def _forget_stale_kernels() -> None:
    """Delete what was compiled from other sources.

    numba looks only at the file of a kernel itself, not at those of the kernels that it calls.
    """
    sources = b"".join(path.read_bytes() for path in sorted(_SOURCES.rglob("*.py")))
    digest = hashlib.sha256(sources).hexdigest()
    if _DIGEST.exists() and _DIGEST.read_text() == digest:
        return
    try:
        for compiled in _SOURCES.rglob("__pycache__/*.nb[ic]"):
            compiled.unlink(missing_ok=True)
        _DIGEST.parent.mkdir(exist_ok=True)
        _DIGEST.write_text(digest)
    except OSError:
        pass  # not ours to write: numba keeps such a package's kernels elsewhere


_forget_stale_kernels()


@cache
def tell_of_compiling() -> None:
    """Say, once in a process, that the next step with liquid compiles first, if so it is.

    A package that is not ours to write into has its kernels elsewhere, compiled or not.
    """
    compiled = any(_SOURCES.rglob("__pycache__/*.nbi"))
    if not compiled and os.access(_SOURCES, os.W_OK):
        logging.getLogger(__name__).warning(
            "Compiling the kernels of the liquid: about half a minute, once per machine"
        )


class _Kernel:
    """A function that is compiled when it is first called, here or by another kernel.

    A program that only sends others to play declares kernels too: it need not load numba, which
    takes a second and 100 MB.
    """

    def __init__(self, function: Callable[..., object]) -> None:
        update_wrapper(self, function)
        self._function = function

    def __call__(self, *arguments: object) -> object:
        return self._compiled(*arguments)

    @cached_property
    def _compiled(self) -> Any:
        from numba import njit

        return njit(cache=True, error_model="numpy")(self._function)

    @property
    def _numba_type_(self) -> object:
        """What numba takes it for in other kernels."""
        return self._compiled._numba_type_


def kernel[Function: Callable[..., object]](function: Function) -> Function:
    """Compile a function at its first call, serially; later processes find it compiled.

    One process per core plays an episode, so that a kernel never asks for a second one. Dividing by
    nothing gives infinity, as in NumPy. Floating point is not reordered (no `fastmath`): with it,
    the process that compiles a kernel computes other last bits than those that find it compiled.
    """
    return cast(Function, _Kernel(function))
