"""Under which condition an episode is played: the key of rows, summaries, tables and comparisons.

Episodes of one condition differ in their seeds only, and only they are counted together.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

from labutopia_lerobot.setting import (
    ALL,
    CLASSIC,
    DEFAULT_ROOM,
    EXACT,
    OF_THE_LEVEL,
    PARTICLES,
    RULES,
    canonical_axes,
    robot_of_level,
)

SINGLE = "single"
"""One policy plays all steps (the paper's SP and, step by step, S1 to Sk)."""

STAGED = "staged"
"""One policy per step, switched on the substeps of the steps (the paper's A1 to Ak)."""

EXPERT, RANDOM, STILL = "expert", "random", "still"
REFERENCES = (EXPERT, RANDOM, STILL)
"""Policies that need no training, and look at no observation."""

ID, OOD, ALL_AXES = "ID", "OOD", "all axes"
"""Names of the usual shifts in tables; the first two are the paper's."""

_MARKED = ("liquid", "particles", "reasoner", "robot", "room", "after")
"""Options that tables mark where they differ from those published, beside shifts and steps."""
_SEEN = ("renderer", "odometry")
"""The same, of what only who looks sees."""


@dataclass(frozen=True)
class Condition:
    """All that decides an episode, beside its seed and the policy. The defaults are published.

    What decides nothing under the rest of a condition is None: particles and reasoner where no
    liquid is simulated, the renderer where no picture is drawn.

    Attributes:
        task: Task id.
        split: `train`, `id` or `ood`.
        axes: Axes that vary, or with `ood` are shifted, beside the task's own; by name, each once.
        play: How steps are played, `single` or `staged`.
        step: The step that is played alone, or None for the whole task.
        after: Step behind which the whole task begins, or None for its start.
        liquid: `on` or `off`; None for a task whose vessels are empty anyway.
        particles: In how many particles the liquid is divided.
        reasoner: Who says what reacts: `rules`, or the label of a file of answers.
        robot: Which robot plays; by default that of the paper for the level of the task.
        room: Where.
        obs: `pixels` or `state`; None in a `scene`.
        renderer: What draws the pictures, `classic` or `filament`.
        odometry: Where the base is observed to be, `exact` or `drift`.
    """

    task: str
    split: str = "id"
    axes: tuple[str, ...] = ()
    play: str = SINGLE
    step: str | None = None
    after: str | None = None
    liquid: str | None = "on"
    particles: int | None = PARTICLES
    reasoner: str | None = RULES
    robot: str = OF_THE_LEVEL
    room: str = DEFAULT_ROOM
    obs: str | None = "pixels"
    renderer: str | None = CLASSIC
    odometry: str = EXACT

    def __post_init__(self) -> None:
        canonical = {
            "axes": canonical_axes(self.axes),
            "robot": robot_of_level(self.task) if self.robot == OF_THE_LEVEL else self.robot,
            # A step played alone begins where the one before it is done, in whatever order.
            "after": self.after if self.step is None else None,
            "particles": self.particles if self.liquid == "on" else None,
            "reasoner": self.reasoner if self.liquid == "on" else None,
            "renderer": (self.renderer or CLASSIC) if self.obs == "pixels" else None,
        }
        for name, value in canonical.items():
            object.__setattr__(self, name, value)

    @property
    def scene(self) -> "Condition":
        """The same without what only the observer sees: equal for policies that met one scene."""
        return replace(self, obs=None, odometry=EXACT)

    @property
    def shift(self) -> str:
        """Things drawn otherwise than in training: `ID`, `OOD` (what the task shifts), ..."""
        if self.axes == (ALL,) and self.split == "ood":
            return ALL_AXES
        name = {"id": ID, "ood": OOD}.get(self.split, self.split)
        return f"{name} {'+'.join(self.axes)}".rstrip()

    @property
    def played(self) -> str:
        """The shift, and what is unusual about how the steps are played."""
        staged = [] if self.play == SINGLE else [self.play]
        alone = [] if self.step is None else [f"{self.step} alone"]
        return ", ".join([self.shift, *staged, *alone])

    def without_task(self, policy: str | None = None) -> str:
        """Return what distinguishes it from others of its task, in words; see `marks`."""
        return ", ".join([self.played, *self.marks(policy)])

    @property
    def description(self) -> str:
        """All of it, in words."""
        return f"{self.task} {self.without_task()}"

    def marks(self, policy: str | None = None) -> list[str]:
        """Return what differs from the published condition beside shift and steps, in words.

        Args:
            policy: Who plays; a reference policy looks at nothing, so that nothing of that matters.
        """
        published = Condition(self.task)
        looks = policy not in REFERENCES
        values = {name: getattr(self, name) for name in (*_MARKED, *_SEEN * looks)}
        unusual = {n: v for n, v in values.items() if v not in (None, getattr(published, n))}
        state = ["state"] * (looks and self.obs == "state")
        return [*state, *(f"{name}={value}" for name, value in unusual.items())]

    def label(self, policy: str) -> str:
        """Return a policy's name with its marks."""
        return ", ".join([policy, *self.marks(policy)])


def differ_in_task_only(conditions: Sequence[Condition]) -> bool:
    """Return whether a mean over conditions is one over tasks: a task may have no liquid."""
    values = {
        field.name: {getattr(condition, field.name) for condition in conditions}
        for field in fields(Condition)
        if field.name != "task"
    }
    for name in ("liquid", "particles", "reasoner"):
        values[name].discard(None)
    return all(len(distinct) <= 1 for distinct in values.values())
