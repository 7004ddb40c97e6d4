"""A laboratory that is compiled: what an episode is played in, and who judges it."""

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.kept_answers import load_answers
from labutopia_lerobot.layout import Workspace, sample_base, sample_layout, taken_over
from labutopia_lerobot.pictures import FARTHEST_M, camera_and_kind
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.processes import AMBIENT
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.robots.action_filter import ActionFilter
from labutopia_lerobot.robots.hand_kinematics import HandKinematics
from labutopia_lerobot.scenario import Scenario
from labutopia_lerobot.scenario.distractors import place_distractors
from labutopia_lerobot.scenario.in_the_way import place_in_the_way
from labutopia_lerobot.scenes import load_room, room_label
from labutopia_lerobot.setting import DEPTH, DRIFT, SEGMENTATION, Setting
from labutopia_lerobot.sim.appearance import Appearance
from labutopia_lerobot.sim.contact_shadows import ContactShadows
from labutopia_lerobot.sim.laser_scan import LaserScan
from labutopia_lerobot.sim.motion import ReactiveMotion
from labutopia_lerobot.sim.renderers import Renderer, open_renderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.segments import segment_names, segment_of_body
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.place import Place
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.substances.substance import ZERO_C
from labutopia_lerobot.task import DIVERGED, SUCCESS, Step, Task, TaskError
from labutopia_lerobot.world import FloatArray


class Workcell:
    """Everything that is compiled for one discrete variant of a task, episode after episode.

    Args:
        scenario: An episode of the variant; others may differ in all that needs no compiling.
        setting: Options of the environment.

    Attributes:
        task: The task of the episode in play.
        steps: Those of its steps that the episode is about.
        after: Step behind which the episode has begun, or None for the start of the task.
        room: What rows and datasets call the room.
        simulation: The physics.
        world: The read-only view of it that predicates and skills get.
        progress: The judge of the episode in play.
        filter: What commands pass through before they act.
    """

    def __init__(self, scenario: Scenario, setting: Setting) -> None:
        self._setting = setting
        self.task = task = scenario.task
        self.steps = task.steps
        self.after: str | None = None
        self._halt: NDArray[np.float32] | None = None
        variation = scenario.variation
        pieces = (*task.start, *variation.distractors, *variation.in_the_way)
        robot = load_robot(setting.robot)
        self.room = room_label(variation.room or setting.room)
        room = load_room(variation.room or setting.room)
        self._workspace = Workspace.of(room, robot)
        self._ground = room.ground(robot.base) if task.drives and robot.base else None
        if self._ground is not None:
            room = room.without(taken_over(task.start, self._ground))
        scene = compile_scene(
            pieces,
            robot,
            room,
            task.view,
            task.contents,
            setting.particles,
            setting.renderer,
            drifts=setting.odometry == DRIFT,
            answers=load_answers(setting.reasoner),
        )
        self.simulation = Simulation(scene)
        self.world = SimulatedWorld(self.simulation)
        self.filter = ActionFilter(robot, HandKinematics(scene.model, robot))
        self.progress = Progress(task)
        self._appearance = Appearance(scene.model)
        self._segment_of_body = segment_of_body(scene, segment_names(task))

    @cached_property
    def motion(self) -> ReactiveMotion:
        """The experts' inverse kinematics, compiled at first use."""
        return ReactiveMotion(self.simulation, self.world)

    @cached_property
    def _scan(self) -> LaserScan:
        scene = self.simulation.scene
        assert scene.robot.base is not None
        return LaserScan(scene, scene.robot.base.scanner)

    @cached_property
    def renderer(self) -> Renderer:
        """The renderer of the setting, made at first use.

        Raises:
            NoFilamentError: If it is Filament, and there is no Vulkan.
            NoOpenGLError: If it is the classic one, and there is no working OpenGL.
        """
        scene = self.simulation.scene
        liquids = [] if scene.liquid is None else [scene.liquid]
        bodies = [piece.name for piece in scene.pieces]
        shadows = ContactShadows(scene.model, bodies, scene.room.bench)
        size = self._setting.width, self._setting.height
        kind, apparatus = self._setting.renderer, self.simulation.apparatus
        return open_renderer(kind, scene.model, *size, liquids, apparatus, shadows)

    def expert(self, skills: Sequence[Skill] | None = None, pace: float = 1.0) -> Expert:
        """Return an expert that plays skills, those of `steps` by default; `start` it.

        Args:
            skills: What it plays.
            pace: How fast its hand moves, as a share of its usual speeds.
        """
        if skills is None:
            skills = [skill for step in self.steps for skill in step.skills]
        return Expert(skills, self.world, self.motion, pace)

    def begin(self, scenario: Scenario, rng: np.random.Generator, after: str | None = None) -> str:
        """Begin an episode: things stand, vessels are full, the setup has been played.

        Args:
            scenario: What the episode has drawn.
            rng: Where its random numbers come from.
            after: Step behind which the episode begins, which the expert plays up to there; None
                for the start or, if a step is played alone, for the one before that.

        Returns:
            Why this start is no good, in words; empty if setup and steps went well.

        Raises:
            TaskError: If the task has no step `after`, or none behind it.
        """
        self.task = task = scenario.task
        until = self._setting.step
        played = task.steps if until is None else task.steps_until(until)
        if after is not None:
            before = task.steps_until(after)
        else:
            before = () if until is None else played[:-1]
        self.steps = played[len(before) :]
        if not self.steps:
            raise TaskError(f"Nothing is left to play behind '{after}': it is the last step")
        self.after = before[-1].name if before else None
        self._halt = None
        variation = scenario.variation
        self._appearance.show(variation)
        celsius = variation.ambient
        self.simulation.apparatus.ambient = AMBIENT if celsius is None else celsius + ZERO_C
        ground = self._ground
        layout = sample_layout(task.start, rng, ground)
        base_pose = None if ground is None else sample_base(ground, layout, rng)
        base = self.simulation.scene.robot.base
        if variation.in_the_way and base and ground and base_pose is not None:
            around = place_in_the_way(
                variation.in_the_way,
                layout,
                base,
                ground,
                base_pose,
                -self.world.bench_height,
                rng,
            )
            if around is None:
                return "there is no room for what is to be in the way"
            layout |= around
        layout |= place_distractors(
            variation.distractors,
            layout,
            self._workspace,
            self.world.robot.vessel_approach.yaw,
            rng,
            self._brought_to(task) if variation.distractors else (),
        )
        self.simulation.reset(layout, variation.robot_start, rng, base_pose)
        self.simulation.fill(rng, task.contents)
        self.filter.start(self.simulation.command)
        amiss = self._play(task.setup) or self._play_steps(before)
        if amiss:
            return amiss
        self.filter.start(self.simulation.command)
        self.simulation.start_clock()
        self.progress = Progress(task, self.after, until)
        self.progress.update(self.world)
        return ""

    def _brought_to(self, task: Task) -> tuple[FloatArray, ...]:
        """Return the points of the bench that the task's things are set down on [m]."""
        skills = (skill for step in task.steps for skill in step.skills)
        return tuple(
            skill.on.position_w(self.world)[:2]
            for skill in skills
            if isinstance(skill, Place) and isinstance(skill.on, OverBench)
        )

    def step(self, action: NDArray[np.float32]) -> None:
        """Command the robot for one control period, and judge what has come of it.

        Behind the end of the episode the robot stays where it is, whatever is commanded.

        Raises:
            ValueError: If the action does not have the shape of the robot's.
        """
        if self.progress.over:
            self._halt = self._here if self._halt is None else self._halt
            action = self._halt
        self.simulation.step(self.filter(action, self.simulation.commands))
        if self.simulation.diverged:
            self.progress.end(DIVERGED)
        self.progress.update(self.world)

    @property
    def _here(self) -> NDArray[np.float32]:
        """The action that leaves arm and base where they are, and what is held in the hand."""
        roles = self.simulation.scene.robot.roles
        action = self.simulation.measured.astype(np.float32)
        action[roles.gripper] = self.simulation.command[roles.gripper]
        action[roles.base] = 0.0
        return action

    def color(self, camera: str) -> NDArray[np.uint8]:
        """Return what a camera sees, shape (height, width, 3)."""
        picture: NDArray[np.uint8] = self.pictures([camera])[camera]
        return picture

    def pictures(self, names: Sequence[str]) -> dict[str, NDArray[Any]]:
        """Return what cameras see now.

        Args:
            names: Of the pictures (see `pictures`).

        Returns:
            Name -> colours or, thrice, the number of what is seen (see `sim.segments`), shape
            (height, width, 3); distance along the optical axis, the line of sight through the
            middle, no further than `FARTHEST_M` [m], shape (height, width, 1).
        """
        self.simulation.draw_liquid()
        return {name: self._picture(*camera_and_kind(name)) for name in names}

    def scan(self) -> NDArray[np.float32]:
        """Return how far the laser scanner of the base sees along every ray [m], shape (beams,)."""
        return self._scan.ranges(self.simulation.data)

    def depth(self, camera: str) -> NDArray[np.float32]:
        """Return the distance along a camera's optical axis [m], shape (height, width)."""
        self.simulation.draw_liquid()
        return self.renderer.depth(self.simulation.data, camera)

    def segmentation(self, camera: str) -> NDArray[np.int32]:
        """Return which body a camera sees, shape (height, width); -1 where it sees none."""
        self.simulation.draw_liquid()
        return self.renderer.segmentation(self.simulation.data, camera)

    def info(self) -> dict[str, Any]:
        """Return what is so now: judge, account of the liquid, and what of the action acted."""
        progress, filtered, liquid = self.progress, self.filter, self.world.liquid
        latched = progress.substeps.items()
        return {
            "is_success": progress.outcome == SUCCESS,
            "ever_success": progress.ever,
            "outcome": progress.outcome,
            "facts": progress.facts,
            "substeps": {name: np.inf if time is None else time for name, time in latched},
            "step": None if progress.step is None else progress.step.name,
            "after": self.after,
            "readings": {name: r.shown for name, r in self.world.displayed.items()},
            **({} if liquid is None else liquid.millilitres),
            **self._chemistry(),
            "applied_action": filtered.applied.copy(),
            "clipped_actions": filtered.clipped,
            "nonfinite_actions": filtered.nonfinite,
        }

    def _chemistry(self) -> dict[str, Any]:
        """Return what vessels hold, and what was left unreacted; nothing without liquid.

        Where nothing is dissolved, at the end of an episode only: little of it changes.
        """
        liquid = self.simulation.liquid
        if liquid is None or (liquid.solutions is None and not self.progress.over):
            return {}
        held = {name: self.world.solution_in(name) for name in liquid.names}
        return {
            "solutions": {name: one.numbers for name, one in held.items() if one is not None},
            "unreacted": () if liquid.solutions is None else liquid.solutions.unreacted,
        }

    def close(self) -> None:
        """Give what the renderer holds back."""
        renderer = self.__dict__.pop("renderer", None)
        if renderer is not None:
            renderer.close()

    def _picture(self, camera: str, kind: str) -> NDArray[Any]:
        data = self.simulation.data
        if kind == DEPTH:
            return np.minimum(self.renderer.depth(data, camera), np.float32(FARTHEST_M))[..., None]
        if kind == SEGMENTATION:
            numbers = self._segment_of_body[self.renderer.segmentation(data, camera)]
            return np.repeat(numbers[..., None], 3, axis=-1)
        return self.renderer.color(data, camera)

    def _play(self, skills: Sequence[Skill]) -> str:
        """Let the expert play skills that nobody judges; return what went amiss, if anything."""
        expert = self.expert(skills)
        expert.start()
        forbidden = self.task.forbidden(None).values()
        while skills and not expert.finished:
            self.simulation.step(self.filter(expert.act(), self.simulation.commands))
            amiss = expert.failure or self._breach(forbidden)
            if amiss or self.simulation.diverged:
                return amiss or DIVERGED
        return ""

    def _breach(self, forbidden: Iterable[Predicate]) -> str:
        """Return what holds now of what must not, in words; empty if nothing does."""
        for fact in forbidden:
            if fact.holds(self.world):
                return ": ".join(filter(None, (fact.name, fact.reason(self.world))))
        return ""

    def _play_steps(self, steps: Sequence[Step]) -> str:
        """Let the expert play the first steps, each until it is done; return what went amiss.

        Who plays the next step takes over at the very moment in which one is done: so do policies
        that are trained on single steps.
        """
        self.simulation.start_clock()
        self.progress = Progress(self.task)
        self.progress.update(self.world)
        for step in steps:
            expert = self.expert(step.skills)
            expert.start()
            while self.progress.step is step and not self.progress.over:
                self.step(expert.act())
                if expert.failure:
                    return expert.failure
        if not self.progress.over:
            return ""
        forbidden = self.task.forbidden(self.progress.step).values()
        return self._breach(forbidden) or self.progress.outcome
