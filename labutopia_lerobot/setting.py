"""Everything that a user chooses about an environment: one value, declared and checked here.

`SettingOptions` declares each option once, with its type, default and help. A program's class of
options inherits it and adds its own; `setting_of` makes the `Setting` of an instance. A new field
there is an option of every program.

What an option is for is said where it is declared, by `option(default, help)`, and is kept in the
field's metadata: `option_help` reads it for `--help`.

Names of robots are data here, and rooms are only looked up where they are loaded: who wants
options waits for no geometry. `scenes.load_room` reports a room that does not exist, which every
program reaches before it writes anything: `LabEnv`, `scenario.canonical_task`, and the classes of
options of LeRobot's programs call it.
"""

import difflib
import inspect
from collections.abc import Collection, Iterable, Mapping
from dataclasses import Field, FrozenInstanceError, asdict, dataclass, field, fields, replace
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.registry import require_task

SPLITS = ("train", "id", "ood")
"""`train`: demonstrations. `id`: the same values, other seeds. `ood`: values never trained on."""

OBSERVATION_KINDS = ("pixels", "state")
"""`pixels`: cameras and `agent_pos`. `state`: `agent_pos` and privileged `environment_state`."""

LIQUID = ("on", "off")
"""Whether what the task's vessels hold is simulated."""

CLASSIC, FILAMENT = "classic", "filament"
RENDERERS = (CLASSIC, FILAMENT)
"""What draws: MuJoCo's OpenGL renderer, or its physically based one, which needs Vulkan."""

RULES = "rules"
"""Who says what reacts, by default; or a file of a language model's answers
(`chemistry.kept_answers`)."""

EXACT, DRIFT = "exact", "drift"
ODOMETRY = (EXACT, DRIFT)
"""Where a base is, as it is observed: as it is, or as its wheels say (`robots.odometry`)."""

SPARSE, DENSE = "sparse", "dense"
REWARDS = (SPARSE, DENSE)
"""The benchmark's reward, and one to learn from by trying (`sim.dense_reward`)."""

CAMERAS = ("front", "top", "wrist")
"""Every camera of a scene: facing the robot, overhead, on the hand."""

DEPTH, SEGMENTATION = "depth", "segmentation"
FORCES, READINGS, SCAN = "forces", "readings", "scan"
NUMBERS = (FORCES, READINGS, SCAN)
"""Extras that need no cameras: forces on the pads, readings of the displays, a laser scan."""

EXTRAS = (DEPTH, SEGMENTATION, *NUMBERS)
"""What can be observed beside the usual: depth and segmentation of every camera, forces on
pads, what displays read, what the laser scanner of a base sees."""

HANDLES, HOMES, LAMPS, DISPLAYS = "handles", "homes", "lamps", "displays"
SIZES, LEVELS, SOLUTIONS = "sizes", "levels", "solutions"
HIDEABLE = (HANDLES, HOMES, LAMPS, DISPLAYS, SIZES, LEVELS, SOLUTIONS)
"""What the privileged state can be left without: places of handles, where things are to be put back
to, whether lamps are lit, what displays show, sizes of things, levels of liquids, what is dissolved
in them (`privileged_state.environment_state_names`)."""

ROBOT_NAMES = ("panda", "iiwa", "ridgeback_panda", "fetch", "fetch_differential")
"""Every robot that can play: the keys of `robots.ROBOTS`."""

DEFAULT_ROBOT = ROBOT_NAMES[0]
"""The robot of the paper's levels 1 to 4."""

MOBILE_ROBOT = "ridgeback_panda"
"""The robot of the paper's level 5."""

OF_THE_LEVEL = "default"
"""As a robot: that of the paper for the level of the task."""

DEFAULT_ROOM = "laboratory"
"""The room of the paper's levels 1 to 4."""

IMAGE_SIZE = 256
"""Width and height of a picture by default [pixels] (paper, "Model Input And Output")."""

PARTICLES = 1000
"""Particles of a scene by default: 0.1 ml each in 100 ml."""

LARGEST_PICTURE = (1920, 1080)
"""Width and height of the image buffer that scenes are compiled with [pixels]."""

ALL = "all"
"""As an axis: every axis that the task has."""

_HELP = "help"
"""Key of an option's metadata."""


class UnknownOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which are possible."""


def option[Value](default: Value, help: str) -> Value:
    """Return a dataclass's field that is an option of a program, with what `--help` says of it."""
    return field(default=default, metadata={_HELP: help})


def options_of(program: type) -> list[Field[Any]]:
    """Return a program's options in the order in which they are listed: its own, then those of all.

    Args:
        program: Its dataclass of options.
    """
    declared = {each.name: each for each in fields(program)}
    named = [*inspect.get_annotations(program), *declared]
    return [declared[name] for name in dict.fromkeys(named) if name in declared]


def option_help(options: type) -> dict[str, str]:
    """Return what is said of each option of a dataclass, by its name."""
    listed = options_of(options)
    return {each.name: each.metadata[_HELP] for each in listed if _HELP in each.metadata}


@dataclass
class SettingOptions:
    """The options of every program that plays: what an episode depends on beside its seed.

    Each class declares `task` itself: some need one, others take several.
    """

    task: Any
    obs: str = option("pixels", "`pixels` (cameras) or `state` (privileged object poses).")
    cameras: tuple[str, ...] = option(
        CAMERAS, "Which cameras to draw with `obs=pixels`: front, top, wrist."
    )
    extras: tuple[str, ...] = option(
        (),
        "Observed beside: a list of `depth` [m] and `segmentation` of every camera, with "
        "`obs=pixels`, `forces` on the pads [N], `readings` of the displays, and `scan` of the "
        "laser scanner of a base [m].",
    )
    hidden: tuple[str, ...] = option(
        (),
        "What the privileged state of `obs=state` is left without: a list of places of `handles`, "
        "`homes`, where things are to be put back to, `lamps`, whether they are lit, `displays`, "
        "what they show, `sizes` of things, `levels` of liquids, and `solutions`, what is "
        "dissolved in them.",
    )
    width: int = option(IMAGE_SIZE, "Width of the pictures [pixels].")
    height: int = option(IMAGE_SIZE, "Height of the pictures [pixels].")
    split: str = option("id", "`train`, `id` (other seeds) or `ood` (values never trained on).")
    axes: tuple[str, ...] = option(
        (),
        "Which axes vary beside the task's own, or, with `split=ood`, which are shifted: a list "
        "such as [material,light], or `all`.",
    )
    tasks_dir: str | None = option(None, "A further folder of tasks.")
    liquid: str = option(
        "on", "`on`; with `off` vessels are empty, pouring and spilling are judged by tilts."
    )
    particles: int = option(PARTICLES, "In how many particles the liquid of a task is divided.")
    reasoner: str = option(
        RULES,
        f"Who says what reacts: `{RULES}`, or FILE.json of a language model's answers, which "
        "`labutopia-chem ask` has written.",
    )
    robot: str = option(
        OF_THE_LEVEL,
        f"Which robot plays: `{OF_THE_LEVEL}` is the paper's ({DEFAULT_ROBOT}, at level 5 "
        f"{MOBILE_ROBOT}), or one of {', '.join(ROBOT_NAMES)}.",
    )
    room: str = option(
        DEFAULT_ROOM,
        "Where: `laboratory`, a furnished room such as `organic_7` that has a work place, or "
        "FILE.json of one that `labutopia-scene generate` made. With `laboratory`, a task in which "
        "one drives draws a furnished room for each episode.",
    )
    odometry: str = option(
        EXACT,
        "Where the base is, in what is observed: `exact`, or `drift`: as its wheels say, "
        "the further it has driven and turned the more wrong.",
    )
    renderer: str = option(
        CLASSIC,
        "`classic` (OpenGL) or `filament` (physically based, needs Vulkan; colours only).",
    )
    reward: str = option(
        SPARSE,
        "`sparse`: 1 on success; `dense`: how much further the episode has come, for reinforcement "
        "learning; success is the same, and no result counts rewards.",
    )
    step: str | None = option(
        None,
        "A step of the task, such as 3_place, to be played alone: the expert plays those before "
        "it, and the episode is over when it is done; null for the whole task.",
    )

    @property
    def chosen(self) -> dict[str, Any]:
        """The value of every option by name, in the order of `options_of`."""
        values = asdict(self)
        return {each.name: values[each.name] for each in options_of(type(self))}


@dataclass(unsafe_hash=True)  # as nothing can be assigned
class Setting(SettingOptions):
    """Everything that an episode depends on beside its seed and who plays it: a checked value.

    It cannot be changed, and is hashed by its fields. `frozen=True` is not for it: dataclasses that
    others fill in, as Hydra and LeRobot do, could not share its fields.

    Raises:
        UnknownOptionError: If a value is impossible; the message says which are possible.
        UnknownTaskError: If there is no such task; the message lists the tasks.
    """

    task: str = field(metadata={_HELP: "Task id, such as `level1/pick`."})

    def __post_init__(self) -> None:
        for name in ("cameras", "extras", "hidden", "axes"):
            value = getattr(self, name)
            object.__setattr__(self, name, (value,) if isinstance(value, str) else tuple(value))
        object.__setattr__(self, "axes", canonical_axes(self.axes))
        if self.tasks_dir is not None:
            object.__setattr__(self, "tasks_dir", str(self.tasks_dir))
        object.__setattr__(self, "room", str(self.room))
        object.__setattr__(self, "reasoner", str(self.reasoner))
        require_choices("obs", [self.obs], OBSERVATION_KINDS)
        require_choices("split", [self.split], SPLITS)
        require_choices("liquid", [self.liquid], LIQUID)
        require_choices("robot", [self.robot], (*ROBOT_NAMES, OF_THE_LEVEL))
        require_choices("odometry", [self.odometry], ODOMETRY)
        require_choices("renderer", [self.renderer], RENDERERS)
        require_choices("reward", [self.reward], REWARDS)
        require_choices("cameras", self.cameras, CAMERAS)
        if not self.cameras or len(set(self.cameras)) < len(self.cameras):
            raise UnknownOptionError(
                f"cameras={list(self.cameras)} must name at least one, and none twice. Choose "
                f"from: {', '.join(CAMERAS)}"
            )
        require_choices("extras", self.extras, EXTRAS)
        if self.obs == "state" and not set(self.extras) <= set(NUMBERS):
            raise UnknownOptionError(
                f"extras={list(self.extras)} needs cameras: choose obs=pixels, or of extras only "
                f"{', '.join(NUMBERS)}"
            )
        if self.renderer == FILAMENT and not set(self.extras) <= set(NUMBERS):
            raise UnknownOptionError(
                f"extras={list(self.extras)} needs renderer=classic: {FILAMENT} draws colours only"
            )
        object.__setattr__(self, "extras", tuple(e for e in EXTRAS if e in self.extras))
        require_choices("hidden", self.hidden, HIDEABLE)
        if self.hidden and self.obs != "state":
            raise UnknownOptionError(
                f"hidden={list(self.hidden)} needs obs=state: pictures show no numbers to hide"
            )
        object.__setattr__(self, "hidden", tuple(h for h in HIDEABLE if h in self.hidden))
        require_between("particles", self.particles, 1, 100_000)
        require_between("width", self.width, 1, LARGEST_PICTURE[0])
        require_between("height", self.height, 1, LARGEST_PICTURE[1])
        require_task(self.task, self.tasks_dir)
        if self.robot == OF_THE_LEVEL:
            object.__setattr__(self, "robot", robot_of_level(self.task))

    def __setattr__(self, name: str, value: object) -> None:
        if name in vars(self) or name not in {each.name for each in fields(self)}:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        raise FrozenInstanceError(f"cannot delete field {name!r}")

    def without_pictures(self) -> "Setting":
        """Return the same with no pictures drawn: `obs=state`, and of the extras the numbers."""
        numbers = tuple(extra for extra in self.extras if extra in NUMBERS)
        return replace(self, obs="state", extras=numbers)


def robot_of_level(task_id: str) -> str:
    """Return the robot that the paper has for the level of a task."""
    return MOBILE_ROBOT if task_id.startswith("level5/") else DEFAULT_ROBOT


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
        UnknownOptionError: If it is not; the message says the range.
    """
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise UnknownOptionError(
            f"{name}={value!r} is impossible: {name} is a whole number from {least} to {most}"
        )


def setting_of(options: SettingOptions, **chosen: Any) -> Setting:
    """Return the setting that the options of a program describe.

    Args:
        options: The instance.
        **chosen: Fields that take other values than the instance's.

    Raises:
        UnknownOptionError: If a value is impossible.
        UnknownTaskError: If there is no such task.
    """
    values: dict[str, Any] = {o.name: getattr(options, o.name) for o in fields(Setting)}
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
