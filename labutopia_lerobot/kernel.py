"""Compiling kernels with numba, once per machine."""

import hashlib
import logging
import os
import shutil
import time
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from pathlib import Path
from typing import Any, cast

_PACKAGE = Path(__file__).parent
_MARK = b"@kernel"
_KEPT_DAYS = 30
"""Days for which unused kernels stay that were compiled from other sources."""


def user_cache() -> Path:
    """Return the folder of what is made once per machine, and can be made again."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "labutopia_lerobot"


@cache
def _compiled_kernels() -> Path:
    """Return where kernels of these sources lie; numba writes into it.

    numba looks only at the file of a kernel itself, not at those of the kernels that it calls: so
    kernels of other sources have another folder.
    """
    sources = (path.read_bytes() for path in sorted(_PACKAGE.rglob("*.py")))
    digest = hashlib.sha256(b"".join(text for text in sources if _MARK in text))
    folder = user_cache() / "kernels" / digest.hexdigest()[:16]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        for other in folder.parent.iterdir():
            if other.stat().st_mtime < time.time() - _KEPT_DAYS * 86400:
                shutil.rmtree(other, ignore_errors=True)
    except OSError:
        pass  # nothing can be written there: numba looks for another place
    return folder


@cache
def announce_compiling() -> None:
    """Say, once in a process, that the next step with liquid compiles first, if so it is."""
    if not any(_compiled_kernels().rglob("*.nbi")):
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
        import numba

        config: Any = numba.config
        before, config.CACHE_DIR = config.CACHE_DIR, str(_compiled_kernels())
        try:
            return numba.njit(cache=True, error_model="numpy")(self._function)
        finally:
            config.CACHE_DIR = before

    @property
    def _numba_type_(self) -> object:
        """Its numba type in other kernels."""
        return self._compiled._numba_type_


def kernel[Function: Callable[..., object]](function: Function) -> Function:
    """Compile a function at its first call, serially; later processes find it compiled.

    One process per core plays an episode, so that a kernel never asks for a second one. Dividing by
    nothing gives infinity, as in NumPy. Floating point is not reordered (no `fastmath`): with it,
    the process that compiles a kernel computes other last bits than those that find it compiled.
    """
    return cast(Function, _Kernel(function))
