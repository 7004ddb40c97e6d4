"""Rows as they might be, written by a generator, of policies whose skill is known."""

import json
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from labutopia_lerobot.evaluation.rows import Row

STEPS = {
    "level1/pick": {"pick": ("gripped", "lifted")},
    "level2/pour_liquid": {
        "pick": ("gripped", "lifted"),
        "pour": ("poured", "righted"),
        "place": ("placed", "released"),
    },
    "level3/pick": {"pick": ("gripped", "lifted")},
    "level3/heat_beaker": {"pick": ("gripped", "lifted"), "press": ("pressed",)},
    "level3/pick_sizes": {"pick": ("gripped", "lifted")},
    **{
        f"level4/{task}": {
            f"{number}_{name}": (f"{number}_{name}/done",)
            for number, name in enumerate(names.split(), start=1)
        }
        for task, names in {
            "clean_beaker": "pick pour place pick shake pour place",
            "drying_beakers": "open pick place pick place close",
            "liquid_fusion": "pick pour place pick pour place pick pour place press",
        }.items()
    },
}
"""Task -> its steps, each with its substeps."""

LEVEL_4 = ("level4/clean_beaker", "level4/drying_beakers", "level4/liquid_fusion")

DRAWN_ORDERS = (
    ("open", "transport_pick", "transport_place", "pour_pick", "pour", "pour_place"),
    ("pour_pick", "pour", "pour_place", "open", "transport_pick", "transport_place"),
)
"""Two of the orders in which level4/open_transport_pour may want its steps."""

CAUSES = ("missed grasp", "dropped", "never reached", "too slow", "spilled")


def written(
    task: str,
    policy: str,
    chance: float,
    *,
    n: int = 120,
    split: str = "id",
    axes: Sequence[str] = (),
    play: str = "single",
    obs: str = "pixels",
    seed: int = 100_000,
    luck: int = 0,
) -> list[Row]:
    """Return rows of episodes in which each step goes well with a chance.

    Args:
        task: One of `STEPS`.
        policy: Who played.
        chance: Chance of each step, once it is come to.
        n: Episodes.
        split: As of a row.
        axes: As of a row.
        play: As of a row.
        obs: As of a row.
        seed: Of the first episode.
        luck: Seed of the generator.
    """
    rng = np.random.default_rng(luck)
    return [
        _episode(rng, task, policy, chance, split, list(axes), play, obs, seed + index)
        for index in range(n)
    ]


def _episode(
    rng: np.random.Generator,
    task: str,
    policy: str,
    chance: float,
    split: str,
    axes: list[str],
    play: str,
    obs: str,
    seed: int,
) -> Row:
    steps = STEPS[task]
    substeps: dict[str, float | None] = dict.fromkeys(
        name for names in steps.values() for name in names
    )
    time, failed = 0.0, False
    for name in substeps:
        time += float(rng.uniform(2.0, 4.0))
        failed = failed or rng.random() > chance ** (1 / 2)
        substeps[name] = None if failed else round(time, 3)
    success = not failed
    poured = "pour" in "".join(steps)
    return Row(
        task=task,
        split=split,
        axes=axes,
        drawn={},
        policy=policy,
        play=play,
        obs=obs,
        seed=seed,
        success=success,
        ever_success=success,
        outcome="success" if success else "timeout",
        steps=round(30 * time),
        seconds=round(time, 3),
        substeps=substeps,
        liquid="on" if poured else None,
        ml_total=100.0 if poured else None,
        ml_poured=None,
        ml_retained=None,
        ml_spilled=None,
        ml_clinging=None,
        ml_in_flight=None,
        clipped_actions=0,
        nonfinite_actions=0,
        cause=None if success else str(rng.choice(CAUSES, p=(0.4, 0.25, 0.2, 0.1, 0.05))),
        step_times={name: substeps[names[-1]] for name, names in steps.items()},
        ml_off_target=round(float(rng.gamma(2, 1.5 if success else 20)), 3) if poured else None,
        mm_off_place=round(float(rng.gamma(2, 3 if success else 40)), 3),
        deg_off_place=round(float(rng.gamma(2, 0.5)), 3),
        unwanted_contacts={} if rng.random() < 0.8 else {"hand and bench": 3},
    )


def in_drawn_order(done: Sequence[int], policy: str = "act") -> list[Row]:
    """Return an episode of level4/open_transport_pour per number of steps that were done."""
    like = written("level4/clean_beaker", policy, 1.0, n=len(done))
    rows = []
    for index, (row, count) in enumerate(zip(like, done, strict=True)):
        order = DRAWN_ORDERS[index % len(DRAWN_ORDERS)]
        times = {name: 2.0 * k if k < count else None for k, name in enumerate(order)}
        success = count == len(order)
        reported = {
            "task": "level4/open_transport_pour",
            "drawn": {"order": ", ".join(order)},
            "success": success,
            "ever_success": success,
            "outcome": "success" if success else "timeout",
            "substeps": {f"{name}/done": time for name, time in times.items()},
            "step_times": times,
        }
        rows.append(replace(row, **reported))
    return rows


def keep(folder: Path, rows: Sequence[Row], **config: Any) -> Path:
    """Write rows as a finished result, and return its folder."""
    folder.mkdir(parents=True)
    chosen = {"policy": {"name": rows[0].policy, "path": None, "device": None}, "liquid": "on"}
    provenance = {
        "commit": "0123456789abcdef0123456789abcdef01234567",
        "uncommitted_changes": False,
        "versions": {"mujoco": "4.0.0", "lerobot": "0.6.1", "transformers": None},
        "machine": "Linux x86_64, 2 cores",
        "config": chosen | config,
    }
    content = {"rows": [asdict(row) for row in rows], "summary": [], "provenance": provenance}
    (folder / "result.json").write_text(json.dumps(content))
    return folder


def every_level(folder: Path) -> list[Path]:
    """Write results of the expert and two policies over all levels; return the folders."""
    chances = {"expert": 1.0, "act": 0.9, "diffusion": 0.72}
    return [
        keep(
            folder / policy,
            [
                row
                for number, task in enumerate(STEPS)
                for part, (split, axes, drop) in enumerate(_PARTS[task.partition("/")[0]])
                for row in written(
                    task,
                    policy,
                    max(0.0, chance - (0.0 if policy == "expert" else drop)),
                    split=split,
                    axes=axes,
                    luck=100 * number + part,
                )
            ]
            + written("level4/clean_beaker", policy, chance, play="staged", n=60),
        )
        for policy, chance in chances.items()
    ]


_PARTS: dict[str, tuple[tuple[str, tuple[str, ...], float], ...]] = {
    "level1": (("id", (), 0.0),),
    "level2": (("id", (), 0.05),),
    "level3": (("id", (), 0.05), ("ood", (), 0.15), ("ood", ("all",), 0.4)),
    "level4": (("id", (), 0.0),),
}
"""Level -> the splits and axes in which it is played, and how much worse a policy is there."""
