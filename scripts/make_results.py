"""`python scripts/make_results.py`: docs/results.md and the tables of the README, of kept results.

Results of `labutopia-experiment` are kept in `eval/experiments/` by `scripts/experiment_rows.py`.
What is not there is "not measured" on the page. What one found out by looking at them is written in
`eval/experiments/findings.md`, and stands on the page before the tables.
"""

from dataclasses import replace
from functools import cache
from pathlib import Path

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.experiment import parse
from labutopia_lerobot.evaluation.condition import REFERENCES
from labutopia_lerobot.evaluation.reporting.paper import NAMES, paper_number
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table, as_markdown
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson
from labutopia_lerobot.experiments.measured import Measured, kept_results
from labutopia_lerobot.experiments.planning import evaluations, parts_of
from labutopia_lerobot.experiments.rates import UNKNOWN

ROOT = Path(__file__).parents[1]
PAGE, README = ROOT / "docs" / "results.md", ROOT / "README.md"
KEPT = ROOT / "eval" / "experiments"
FINDINGS = KEPT / "findings.md"
BEGIN, END = "<!-- results -->\n", "<!-- end of results -->"

_HEAD = """# Results

[To the README](../README.md)

Of the {all} evaluations of learned policies below {known} are measured; each table says which
are not. State policies are given the poses of all things and see no pictures: their numbers are not
comparable with the paper's, which stand [beside them](#beside-the-paper). The expert's rows are in
the [table of tasks](tasks.md) and in [failures](failures.md); what an interval means is in
[statistics](statistics.md), how to repeat a row or add one [at the end](#how-they-are-made).

"""

_HOW = """## How they are made

This page is made by `scripts/make_results.py` of the experiments in
[configs/experiment](../configs/experiment) and the results kept in `eval/experiments/`.

```
labutopia-experiment experiment=results_cpu plan=true            # what would be done; nothing is
make results-cpu                                                 # everything that needs no GPU
labutopia-experiment experiment=results_cpu only=level1/pick     # one task of the tables
labutopia-experiment experiment=controls                         # what one thing changes
labutopia-experiment experiment=expert_elsewhere                 # every axis, another arm, rooms
labutopia-experiment experiment=other_robots                     # robots that drive, people about
make results-gpu                                                 # the paper's settings, on one GPU
labutopia-experiment experiment=results_gpu kit=KIT              # for a GPU without a network
```

- An experiment records demonstrations, verifies them, trains with `lerobot-train` by the
  [recipes](../policies/README.md), evaluates and compares, task by task. Before it begins it says
  what it will cost, in hours, gigabytes and memory, by what parts like these took on this
  machine, or by a warm-up in small.
- Each part has the hashes of its inputs: a dataset's content, recipe, options, sources, versions.
  What was made from the same ones stands and is not done again. What was made from others is
  refused before anything runs; `again=true` makes it anew. A training depends on the dataset's
  content and not on our sources, so that new code which records the same bytes trains nothing
  again.
- A killed one goes on with the same command, a training from its last checkpoint. A part that
  fails leaves the others standing; the tables say "not measured", and why.
- `launcher=ray` joins the cluster at `RAY_ADDRESS`, whose machines share `out`, or starts one of
  this machine: parts that do not need each other run at the same time, as cores and GPUs allow,
  and go on elsewhere when a machine is lost.
- `trainings=3` trains three times, from one seed to the next, and evaluates each.
- A study with `control=act` differs from that of `act` in one thing, such as `particles: 300`, and
  is compared with it on common seeds.
- `kit=KIT` records and verifies, and fills a folder for a machine that has a GPU, Python with
  torch, and no network: recordings, recipes, commands, packages. `bash KIT/train.sh 600 4` there
  trains four at once for ten minutes, and goes on when it is called again. `KIT/train`, copied back
  below `out`, is what the experiment then evaluates, with `device=cpu` where there is no GPU.
- `out/report.html` has tables, curves, causes and films; `out/logs/` what every program said.
"""


@clear_errors
def main() -> None:
    """Write the page, and the tables of the README."""
    PAGE.write_text(content())
    README.write_text(readme())


def content() -> str:
    """Return the page."""
    kept = measured("results_cpu")
    changed = measured("controls")
    tables = [*kept.tables(), *changed.trainings(), *changed.controls()]
    shown = "\n".join(map(as_markdown, [*tables, beside_the_paper()]))
    of_the_expert = map(as_markdown, (elsewhere(), other_robots()))
    head = _HEAD.format(all=len(kept.evaluations), known=len(kept.results))
    parts = (FINDINGS.read_text(), shown, _with_pictures(), *of_the_expert, _HOW)
    return head + "\n".join(parts)


def beside_the_paper() -> Table:
    """Return the paper's numbers beside ours, wherever both have measured one task."""
    table, lines = measured("results_cpu").by_task(), list[tuple[Cell, ...]]()
    for task, played, *rates in table.lines:
        ours = dict(zip(table.head[2:], rates, strict=True))
        theirs = {name: paper_number(str(task), name, str(played).upper()) for name in NAMES}
        both = [name for name in NAMES if theirs[name] and isinstance(ours.get(name), Rate)]
        if both:
            beside = (each for name in ("act", "diffusion") for each in (ours[name], theirs[name]))
            lines.append((task, played, *beside))
    head = ("Task", "Condition", "act", "paper's ACT", "diffusion", "paper's DP")
    note = (
        "Not comparable: the paper's policies see pictures of Isaac Sim, ours the poses of all "
        "things; demonstrations, scenes, thresholds and how long a goal must hold are others; the "
        "paper does not say of how many episodes its numbers are. To be compared with it, "
        "policies are trained on pictures with its settings: `make results-gpu`, not measured."
    )
    return Table("Beside the paper", head, tuple(lines), note)


def _with_pictures() -> str:
    kept = measured("small_pictures", "paper_short")
    tables = (replace(each, title=f"{each.title}, with pictures") for each in kept.tables())
    state = f"{len(kept.results)} of {len(kept.evaluations)} evaluations measured"
    return (
        "## With pictures\n\n"
        f"Two cameras, from scratch: {state}. `act_small` at 96x96, which needs no GPU "
        "(`experiment=small_pictures`),\n`act_short`, the paper's ACT at 256x256 "
        "with a few of its steps (`experiment=paper_short`). The paper's settings in full\n"
        "(`make results-gpu`): not measured.\n\n" + "\n".join(map(as_markdown, tables))
    )


def elsewhere() -> Table:
    """Return the expert's successes where it is not usually measured, of all rooms together."""
    kept = measured("expert_elsewhere", learned=False)
    of: dict[str, dict[str, list[Rate]]] = {}
    for each in kept.evaluations:
        where = "furnished rooms" if "room" in dict(each.options) else each.label.replace("_", " ")
        rate = kept.rate(each)
        of.setdefault(each.task, {}).setdefault(where, []).extend(
            [rate] if isinstance(rate, Rate) else []
        )
    places = list(dict.fromkeys(where for by_place in of.values() for where in by_place))
    lines = [
        (task, *(_together(by_place[where]) for where in places)) for task, by_place in of.items()
    ]
    note = (
        "Successes of episodes, per cent, 95 % interval (Wilson): `experiment=expert_elsewhere`. "
        "Every axis of the task varied; another arm; ten episodes in each of ten furnished rooms."
    )
    return Table("The expert elsewhere", ("Task", *places), tuple(lines), note)


def other_robots() -> Table:
    """Return the expert's successes with other robots than a task's own, or in their way."""
    note = (
        "Successes of episodes, per cent, 95 % interval (Wilson): `experiment=other_robots`. "
        "Fetch's meshes are an extra, `fetch`. `dynamic`: a left stool or somebody who walks is "
        "[in the way](navigation.md#in-the-way)."
    )
    table = measured("other_robots", learned=False).by_task()
    return replace(table, title="The expert with other robots", note=note)


def _together(rates: list[Rate]) -> Cell:
    """Return the successes of several evaluations, or that none is measured."""
    count, n = sum(rate.count for rate in rates), sum(rate.n for rate in rates)
    return Rate(count, n, wilson(count, n)) if n else UNKNOWN


def readme() -> str:
    """Return the README with what is measured of levels 1 to 4: a line per policy and level."""
    by_step = _of_levels("4", beside="id, staged")
    tables = "\n".join([*_of_levels("1"), "", *_of_levels("2", "3"), "", *by_step])
    before, _, rest = README.read_text().partition(BEGIN)
    _, _, after = rest.partition(END)
    return before + BEGIN + tables + "\n" + END + after


def _of_levels(*levels: str, beside: str = "ood") -> list[str]:
    """Return a table's lines: per cent of each policy and level, `id`, or `id / BESIDE`.

    Tasks of one name stand in one column.

    Args:
        *levels: Which.
        beside: The condition that stands beside `id` where it is known.
    """
    table = measured("results_cpu").by_task()
    shown = dict[tuple[str, str], dict[str, dict[object, str]]]()
    for task, played, *rates in table.lines:
        level, _, name = str(task).removeprefix("level").partition("/")
        for policy, rate in zip(table.head[2:], rates, strict=True):
            if level in levels and played in ("id", beside) and isinstance(rate, Rate):
                line = shown.setdefault((policy, level), {})
                line.setdefault(name, {})[played] = str(int(rate.percent + 0.5))
    names = sorted({name for line in shown.values() for name in line})
    lines = [f"| {' | '.join(['%', *names])} |", "| --- " * (1 + len(names)) + "|"]
    for policy, level in sorted(shown, key=lambda of: (of[1], table.head.index(of[0]))):
        cells = (_both(shown[policy, level].get(name, {}), beside) for name in names)
        lines.append(f"| {' | '.join([f'{policy}, level {level}', *cells])} |")
    return lines


def _both(rates: dict[object, str], beside: str) -> str:
    """Return what is known of `id` and of the condition beside it."""
    known = rates.get("id", "-")
    return f"{known} / {rates[beside]}" if beside in rates else known


@cache
def measured(*experiments: str, learned: bool = True) -> Measured:
    """Return what is kept of the learned policies of experiments, or of the others."""
    chosen = (parse([f"experiment={each}"]) for each in experiments)
    wanted = (each for of_one in chosen for each in evaluations(parts_of(of_one)))
    return kept_results(KEPT, [e for e in wanted if learned != (e.policy in REFERENCES)])


if __name__ == "__main__":
    main()
