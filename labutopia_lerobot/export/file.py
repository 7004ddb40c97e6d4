"""Writing a file, opening it again and comparing the two."""

from importlib.util import find_spec
from pathlib import Path

import mujoco

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.export.mjcf import write_mjcf
from labutopia_lerobot.export.subject import ExportSubject
from labutopia_lerobot.export.summary import Summary, summary_of_model

_MJCF, _USD = (".xml",), (".usda", ".usdc")
SUFFIXES = _MJCF + _USD
"""Suffixes of exported files: MJCF, OpenUSD as text, OpenUSD as binary."""


class ExportError(UserError, ValueError):
    """A file that cannot be written; the message says why and the cure."""


class DamagedExportError(RuntimeError):
    """A file that does not say what it should: a bug of the exporter."""


def export(subject: ExportSubject, out: Path) -> Summary:
    """Write a file, over one that is there, open it again and compare.

    The same subject gives the same bytes. Textures go into a folder beside the file.

    Args:
        subject: What to write.
        out: The file; its suffix, one of `SUFFIXES`, says as what.

    Returns:
        What the file says.

    Raises:
        DamagedExportError: If it does not say what it should.
        ExportError: If it cannot be written (see `require_writable`).
    """
    require_writable(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    model, data = subject.model, _start(subject.model)
    if out.suffix in _MJCF:
        write_mjcf(subject.spec, out)
        again = mujoco.MjModel.from_xml_path(str(out))
        exported = summary_of_model(again, _start(again))
    else:
        from labutopia_lerobot.export.usd import write_usd  # here: pxr is an extra
        from labutopia_lerobot.export.usd_summary import summary_of_stage

        write_usd(model, data, subject.name, out)
        exported = summary_of_stage(out)
    differences = summary_of_model(model, data).differences(exported)
    if differences:
        raise DamagedExportError("\n".join((f"{out}, opened again, differs:", *differences)))
    return exported


def require_writable(out: Path) -> None:
    """Make sure, before anything is built, that a file can be written.

    Raises:
        ExportError: If its suffix is none of `SUFFIXES`, if it is a folder, or if it is to be
            OpenUSD and the extra `usd` is not installed.
    """
    if out.suffix not in SUFFIXES:
        raise ExportError(f"'{out}' ends on none of {', '.join(SUFFIXES)}: name a file that does")
    if out.is_dir():
        raise ExportError(f"'{out}' is a folder: name a file")
    if out.suffix in _USD and find_spec("pxr") is None:
        raise ExportError(
            "OpenUSD needs usd-core: pip install 'lerobot_env_labutopia[usd]'; MJCF (.xml) does not"
        )


def _start(model: mujoco.MjModel) -> mujoco.MjData:
    """Return the pose to be written: that of the keyframe, if there is one."""
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return data
