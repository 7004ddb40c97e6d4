"""Which OpenGL MuJoCo is to use; it asks once, when it is first imported."""

import ctypes
import os
import sys

_LIBRARIES = {"egl": "libEGL.so.1", "osmesa": "libOSMesa.so.8"}


def choose_backend() -> None:
    """Set `MUJOCO_GL`: EGL where there is no display, and none where it cannot be loaded.

    Without this, importing MuJoCo fails where OpenGL is missing, even if nothing is ever drawn. A
    renderer then raises `NoOpenGLError`, which says the cure.
    """
    if sys.platform != "linux":
        return
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        os.environ.setdefault("MUJOCO_GL", "egl")
    library = _LIBRARIES.get(os.environ.get("MUJOCO_GL", ""))
    if library is not None and not _loads(library):
        os.environ["MUJOCO_GL"] = "disable"


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True
