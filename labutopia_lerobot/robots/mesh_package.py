"""Packages of others that have the meshes of robots."""

from importlib.metadata import PackageNotFoundError, distribution, version
from pathlib import Path
from typing import NamedTuple

from labutopia_lerobot.errors import UserError


class NoMeshesError(UserError, ModuleNotFoundError):
    """The package that a robot's meshes are in is not installed; the message says how it is."""


class MeshPackage(NamedTuple):
    """An installed package with meshes.

    Attributes:
        name: What it is called where packages are.
        folder: Where the meshes are in it.
        extra: Of this package's extras that which brings it; None if it always comes along.
    """

    name: str
    folder: str
    extra: str | None = None

    @property
    def version(self) -> str:
        """Its version.

        Raises:
            NoMeshesError: If it is not installed.
        """
        self.require()
        return version(self.name)

    def require(self) -> None:
        """Make sure that it is installed.

        Raises:
            NoMeshesError: If it is not.
        """
        try:
            distribution(self.name)
        except PackageNotFoundError:
            wanted = self.name if self.extra is None else f"lerobot_env_labutopia[{self.extra}]"
            raise NoMeshesError(
                f"The robot is drawn with meshes of {self.name}, which is not installed. Run "
                f"pip install '{wanted}', or choose another robot"
            ) from None

    def path(self, name: str) -> Path:
        """Return where a mesh lies.

        Raises:
            FileNotFoundError: If there is none of that name.
        """
        path = Path(str(distribution(self.name).locate_file(f"{self.folder}/{name}")))
        if not path.is_file():
            raise FileNotFoundError(f"{self.name} {self.version} has no mesh {name!r}.")
        return path


RTB_DATA = MeshPackage("rtb-data", "rtbdata")
"""Data of the Robotics Toolbox (P. Corke), MIT."""

FETCH_MESHES = MeshPackage(
    "gymnasium-robotics", "gymnasium_robotics/envs/assets/stls/fetch", extra="fetch"
)
"""Assets of gymnasium-robotics (Farama), MIT."""
