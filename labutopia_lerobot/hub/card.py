"""Filling in a card: metadata that the Hub reads, and a page for people."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from huggingface_hub import DatasetCard, DatasetCardData, ModelCard, ModelCardData
from jinja2 import Environment, PackageLoader, StrictUndefined

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import Condition
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.rows import EvaluationSummary
from labutopia_lerobot.foreign_files import printable

CITATION = """\
@misc{li2025labutopia,
  title = {{LabUtopia}: High-Fidelity Simulation and Hierarchical Benchmark for Scientific Embodied
           Agents},
  author = {Li, Rui and Hu, Zixuan and Qu, Wenxi and Zhang, Jinouwen and Yin, Zhenfei and
            Zhang, Sha and Huang, Xuantuo and Wang, Hanqing and Wang, Tai and Pang, Jiangmiao and
            Ouyang, Wanli and Bai, Lei and Zuo, Wangmeng and Duan, Ling-Yu and Zhou, Dongzhan and
            Tang, Shixiang},
  year = {2025},
}"""
"""The paper, as its title page has it."""


class UnfinishedResultError(UserError):
    """A result that no card shows, because episodes are missing."""


TAGS = ("LeRobot", "labutopia", "laboratory", "mujoco", "robotics", "simulation")

_MARKUP = {"<": "&lt;", "![": "!\\[", "|": "\\|"}
"""Character that begins HTML, a picture or another column -> its escape in Markdown."""


class _Finished(str):
    """A text that is Markdown or YAML already."""


def _escaped(value: object) -> object:
    """Return a text from somebody's files for a card, in one line and without markup."""
    if not isinstance(value, str) or isinstance(value, _Finished):
        return value
    text = printable(value)
    for mark, shown in _MARKUP.items():
        text = text.replace(mark, shown)
    return text


_TEMPLATES = Environment(
    loader=PackageLoader("labutopia_lerobot.hub"),
    undefined=StrictUndefined,
    autoescape=False,  # Markdown, not HTML
    finalize=_escaped,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


def dataset_card(template: str, metadata: DatasetCardData, **content: Any) -> str:
    """Return a card for a dataset, in Markdown.

    Args:
        template: Name of a file in `templates`.
        metadata: What the Hub reads.
        **content: What the template asks for.

    Raises:
        ValueError: If huggingface_hub cannot read the metadata back.
    """
    text = _filled(template, metadata.to_yaml(), content)
    DatasetCard(text)
    return text


def model_card(template: str, metadata: ModelCardData, **content: Any) -> str:
    """Return a card for a policy or an environment, which the Hub calls models; see above."""
    text = _filled(template, metadata.to_yaml(), content)
    ModelCard(text)
    return text


def rate(successes: int, n: int, interval: tuple[float, float]) -> str:
    """Return a rate in words, such as `99 of 100 (95 %: 95 to 100 %)`."""
    low, high = interval
    return f"{successes} of {n} (95 %: {100 * low:.0f} to {100 * high:.0f} %)"


def summary_row(summary: EvaluationSummary) -> dict[str, str]:
    """Return what a table of results says of one policy under one condition."""
    seconds, condition = summary.mean_seconds_to_success, summary.condition
    return {
        "task": condition.task,
        "condition": condition.without_task(summary.policy),
        "success": rate(summary.successes, summary.n, summary.interval),
        "seconds": "-" if seconds is None else f"{seconds:.1f}",
    }


def finished_summaries(results: Sequence[LoadedResult]) -> list[list[EvaluationSummary]]:
    """Return the summaries of each result.

    Raises:
        UnfinishedResultError: If one is not finished: its rates are those of the episodes so far.
    """
    for result in results:
        if not result.finished:
            raise UnfinishedResultError(
                f"{result.place} is not finished ({len(result.rows)} episodes so far), and no "
                "card shows it: let the evaluation end first; the same command goes on"
            )
    return [result.summaries for result in results]


def options(condition: Condition) -> str:
    """Return the whole of a condition as options of `eval/run.py`."""
    values = asdict(condition) | {"axes": f"[{','.join(condition.axes)}]"}
    return " ".join(f"{name}={'null' if v is None else v}" for name, v in values.items())


def _filled(template: str, metadata: str, content: dict[str, Any]) -> str:
    return _TEMPLATES.get_template(template).render(
        metadata=_Finished(metadata), citation=_Finished(CITATION), **content
    )
