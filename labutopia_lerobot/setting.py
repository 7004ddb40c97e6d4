"""Everything that a user chooses about an environment: one value, declared and checked here.

Programs take their options from the fields of `Setting`: `@with_setting` gives a class of options
every field that it does not declare itself, and `setting_of` makes a `Setting` of an instance. A
new field is an option of every program, with its help.
"""

import difflib
import inspect
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import MISSING, asdict, dataclass, fields, replace
from typing import Any, dataclass_transform

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.registry import require_task
from labutopia_lerobot.robots import DEFAULT_ROBOT, ROBOTS
from labutopia_lerobot.scenes import DEFAULT_ROOM, load_room, room_label

SPLITS = ("train", "id", "ood")
"""`train`: demonstrations. `id`: the same values, other seeds. `ood`: values never trained on."""

OBSERVATION_KINDS = ("pixels", "state")
"""`pixels`: cameras and `agent_pos`. `state`: `agent_pos` and privileged `environment_state`."""

LIQUID = ("on", "off")
"""Whether what the task's vessels hold is simulated."""

CLASSIC, FILAMENT = "classic", "filament"
RENDERERS = (CLASSIC, FILAMENT)
"""What draws: MuJoCo's OpenGL renderer, or its physically based one, which needs Vulkan."""

CAMERAS = ("front", "top", "wrist")
"""Every camera of a scene: facing the robot, overhead, on the hand."""

DEPTH, SEGMENTATION, FORCES = "depth", "segmentation", "forces"
EXTRAS = (DEPTH, SEGMENTATION, FORCES)
"""What can be observed beside the usual: depth and segmentation of every camera, forces on pads."""

IMAGE_SIZE = 256
"""Width and height of a picture by default [pixels] (paper, "Model Input And Output")."""

PARTICLES = 1000
"""Particles of a scene by default: 0.1 ml each in 100 ml."""

LARGEST_PICTURE = (1920, 1080)
"""Width and height of the image buffer that scenes are compiled with [pixels]."""

ALL = "all"
"""As an axis: every axis that the task has."""


class UnknownOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which are possible."""


@dataclass(frozen=True)
class Setting:
    """Everything that an episode depends on beside its seed and who plays it.

    Attributes:
        task: Task id, such as `level1/pick`.
        obs: `pixels` (cameras) or `state` (privileged object poses).
        cameras: Which cameras to draw with `obs=pixels`: front, top, wrist.
        extras: What is observed beside: a list of `depth` [m] and `segmentation` of every camera,
            with `obs=pixels`, and `forces` on the pads [N].
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].
        split: `train`, `id` (other seeds) or `ood` (values never trained on).
        axes: Which axes vary beside the task's own, or, with `split=ood`, which are shifted: a list
            such as [material,light], or `all`.
        tasks_dir: A further folder of tasks.
        liquid: `on`; with `off` vessels are empty, pouring and spilling are judged by tilts.
        particles: In how many particles the liquid of a task is divided.
        robot: Which arm plays, one of `robots.ROBOTS`.
        room: Where: `laboratory`, a furnished room such as `organic_7` that has a work place, or
            FILE.json of one that `labutopia-scene generate` made.
        renderer: `classic` (OpenGL) or `filament` (physically based, needs Vulkan; colours only).
        step: A step of the task, such as 3_place, to be played alone: the expert plays those
            before it, and the episode is over when it is done; null for the whole task.

    Raises:
        UnknownOptionError: If a value is impossible; the message says which are possible.
        UnknownTaskError: If there is no such task; the message lists the tasks.
    """

    task: str
    obs: str = "pixels"
    cameras: tuple[str, ...] = CAMERAS
    extras: tuple[str, ...] = ()
    width: int = IMAGE_SIZE
    height: int = IMAGE_SIZE
    split: str = "id"
    axes: tuple[str, ...] = ()
    tasks_dir: str | None = None
    liquid: str = "on"
    particles: int = PARTICLES
    robot: str = DEFAULT_ROBOT
    room: str = DEFAULT_ROOM
    renderer: str = CLASSIC
    step: str | None = None

    def __post_init__(self) -> None:
        for name in ("cameras", "extras", "axes"):
            value = getattr(self, name)
            object.__setattr__(self, name, (value,) if isinstance(value, str) else tuple(value))
        object.__setattr__(self, "axes", canonical_axes(self.axes))
        if self.tasks_dir is not None:
            object.__setattr__(self, "tasks_dir", str(self.tasks_dir))
        object.__setattr__(self, "room", str(self.room))
        require_choices("obs", [self.obs], OBSERVATION_KINDS)
        require_choices("split", [self.split], SPLITS)
        require_choices("liquid", [self.liquid], LIQUID)
        require_choices("robot", [self.robot], ROBOTS)
        load_room(self.room)  # it must be one that can be played in
        require_choices("renderer", [self.renderer], RENDERERS)
        require_choices("cameras", self.cameras, CAMERAS)
        if not self.cameras or len(set(self.cameras)) < len(self.cameras):
            raise UnknownOptionError(
                f"cameras={list(self.cameras)} must name at least one, and none twice. Choose "
                f"from: {', '.join(CAMERAS)}"
            )
        require_choices("extras", self.extras, EXTRAS)
        if self.obs == "state" and not set(self.extras) <= {FORCES}:
            raise UnknownOptionError(
                f"extras={list(self.extras)} needs cameras: choose obs=pixels, or of extras only "
                f"{FORCES}"
            )
        if self.renderer == FILAMENT and not set(self.extras) <= {FORCES}:
            raise UnknownOptionError(
                f"extras={list(self.extras)} needs renderer=classic: {FILAMENT} draws colours only"
            )
        object.__setattr__(self, "extras", tuple(e for e in EXTRAS if e in self.extras))
        require_between("particles", self.particles, 1, 100_000)
        require_between("width", self.width, 1, LARGEST_PICTURE[0])
        require_between("height", self.height, 1, LARGEST_PICTURE[1])
        require_task(self.task, self.tasks_dir)

    @property
    def described(self) -> dict[str, Any]:
        """Every field by name, as datasets have it: a room in a file by its content, no folder."""
        told = asdict(self) | {"room": room_label(self.room)}
        del told["tasks_dir"]
        return told

    def without_pictures(self) -> "Setting":
        """Return the same with no pictures drawn: `obs=state`, and of the extras the numbers."""
        numbers = tuple(extra for extra in self.extras if extra == FORCES)
        return replace(self, obs="state", extras=numbers)


def canonical_axes(axes: Iterable[str]) -> tuple[str, ...]:
    """Return axes by name, each once: their order decides nothing; `all` says the others too."""
    named = set(axes)
    return (ALL,) if ALL in named else tuple(sorted(named))


def require_choices(name: str, values: Iterable[object], choices: Collection[object]) -> None:
    """Make sure that every value of the option `name` is one of the choices.

    Raises:
        UnknownOptionError: If one is not; the message lists the choices.
    """
    for value in values:
        if value not in choices:
            listed = ", ".join(str(choice) for choice in choices)
            raise UnknownOptionError(f"{name}={value!r} is unknown. Choose from: {listed}")


def require_between(name: str, value: int, least: int, most: int) -> None:
    """Make sure that the option `name` is a whole number from `least` to `most`.

    Raises:
        UnknownOptionError: If it is not; the message tells the range.
    """
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise UnknownOptionError(
            f"{name}={value!r} is impossible: {name} is a whole number from {least} to {most}"
        )


@dataclass_transform()
def with_setting[Options](options: type[Options]) -> type[Options]:
    """Make a class of options a dataclass that has every field of `Setting` too.

    Fields that it declares itself keep their own type, default and help.
    """
    own = inspect.get_annotations(options)
    inherited: dict[str, Any] = {}
    for option in fields(Setting):
        if option.name in own or option.default is MISSING:
            continue
        inherited[option.name] = option.type
        setattr(options, option.name, option.default)
    options.__annotations__ = own | inherited
    return dataclass(options)


def setting_of(options: object, **chosen: Any) -> Setting:
    """Return the setting that an instance of a class `with_setting` describes.

    Args:
        options: The instance.
        **chosen: Fields that take other values than the instance's.

    Raises:
        UnknownOptionError: If a value is impossible.
        UnknownTaskError: If there is no such task.
    """
    values: dict[str, Any] = {o.name: getattr(options, o.name, None) for o in fields(Setting)}
    return Setting(**(values | chosen))


def setting_from(options: Mapping[str, Any]) -> Setting:
    """Return the setting of options by name.

    Raises:
        UnknownOptionError: If there is no such option, or a value is impossible.
        UnknownTaskError: If there is no such task.
    """
    names = [option.name for option in fields(Setting)]
    for name in options:
        if name not in names:
            near = difflib.get_close_matches(name, names, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise UnknownOptionError(f"'{name}' is no option.{hint} Options: {', '.join(names)}")
    return Setting(**options)


def option_help(options: type) -> dict[str, str]:
    """Return what the docstrings of a class `with_setting` and of `Setting` say of each option."""
    documented = [*reversed(Setting.__mro__), options]
    told = {name: text for kind in documented for name, text in _attributes(kind).items()}
    return told | {"robot": told["robot"].replace("`robots.ROBOTS`", ", ".join(ROBOTS))}


def _attributes(documented: type) -> dict[str, str]:
    """Return the entries of the section `Attributes` of a docstring in Google form."""
    section = (inspect.getdoc(documented) or "").partition("Attributes:\n")[2].partition("\n\n")[0]
    entries = re.findall(r"^ {4}(\w+): (.*(?:\n {8}.*)*)", section, re.MULTILINE)
    return {name: " ".join(text.split()) for name, text in entries}
