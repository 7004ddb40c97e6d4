"""Choice of MuJoCo's OpenGL; it asks once, when it is first imported."""

import ctypes
import os
import sys

BACKENDS = ("egl", "osmesa", "glfw")
"""Values that `MUJOCO_GL` may have on Linux."""

_SWITCHES = ("", "enable", "enabled", "on", "true", "1", "glx")
_OFF = ("disable", "disabled", "off", "false", "0")
_LIBRARIES = {"egl": "libEGL.so.1", "osmesa": "libOSMesa.so.8"}


_REFUSED = "LABUTOPIA_REFUSED_MUJOCO_GL"
"""Environment variable that informs worker processes which value of `MUJOCO_GL` was unknown."""


def choose_backend() -> None:
    """Set `MUJOCO_GL`: EGL where there is no display, and none where it cannot be loaded.

    Without this, importing MuJoCo fails where OpenGL is missing or the value is unknown, even if
    nothing is ever drawn. A renderer then raises `NoOpenGLError`, which says the cure.
    """
    if sys.platform != "linux":
        return
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        os.environ.setdefault("MUJOCO_GL", "egl")
    value = os.environ.get("MUJOCO_GL", "").lower().strip()
    if value not in (*BACKENDS, *_SWITCHES, *_OFF):
        os.environ[_REFUSED] = value
        os.environ["MUJOCO_GL"] = "disable"
    library = _LIBRARIES.get(os.environ.get("MUJOCO_GL", ""))
    if library is not None and not _loads(library):
        os.environ["MUJOCO_GL"] = "disable"


def refused_backend() -> str | None:
    """Return the value of `MUJOCO_GL` that MuJoCo does not know, if the user has set such a one."""
    return os.environ.get(_REFUSED)


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True
