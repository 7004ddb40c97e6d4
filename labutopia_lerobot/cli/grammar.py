"""One grammar of options for every program: `name=value`, `--name value`, `--name=value`.

Several values are `a,b`, `[a,b]` or, after `--name`, `a b`. A word alone is a task where one is
wanted. Only what is an option's name is taken as one: a folder may be called `runs/lr=1e-4`.
"""

import argparse
import difflib
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args, get_origin

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import options_of

ABOUT = "Options: name=value, --name value or --name=value. Several values: a,b or [a,b]."
"""What the help of every program says."""

_TASK = ("task", "tasks")
_TRUTH = {"true": True, "false": False}
_PLAIN = re.compile(r"[\w\-./@:+ ]*|'.*'|\".*\"")
"""Text that means itself to Hydra."""


class OptionParser(argparse.ArgumentParser):
    """A parser of flags that takes `name=value` too, as do its commands."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **({"epilog": ABOUT} | kwargs))

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse what every option was made a flag of."""
        words = list(sys.argv[1:] if args is None else args)
        return super().parse_known_args(self._as_flags(words), namespace)

    def _as_flags(self, words: Sequence[str]) -> list[str]:
        """Return tasks that were named, then words, then what was `name=value`."""
        end = words.index("--") if "--" in words else len(words)
        tasks: list[str] = []
        others: list[str] = []
        named: list[str] = []
        several: argparse.Action | None = None  # the flag whose values come
        for word in words[:end]:
            name, equals, value = word.partition("=")
            is_flag = word.startswith("-")
            action = self._option(name) if equals or is_flag else None
            if action is None:
                several = None if is_flag else several
                others += [word] if several is None else _values(several, word)
                continue
            several = None
            if not action.option_strings:
                tasks += _split(value)
            elif equals:
                named += self._flag(action, value)
            else:
                others.append(action.option_strings[-1])
                several = action if _takes_several(action) else None
        return [*tasks, *others, *named, *words[end:]]

    def _option(self, name: str) -> argparse.Action | None:
        """Return the option of a name, with dashes or without, or the task."""
        bare = name.removeprefix("--").replace("-", "_")
        for action in self._actions:
            if action.dest == bare and action.option_strings:
                return action
            if bare in _TASK and action.dest in _TASK:
                return action
        return None

    def _flag(self, action: argparse.Action, value: str) -> list[str]:
        """Return the words of a flag and its value."""
        flag = action.option_strings[-1]
        if action.nargs != 0:
            several = _takes_several(action)
            return [flag, *_values(action, value)] if several else [f"{flag}={value}"]
        if value.lower() not in _TRUTH:
            self.error(f"{action.dest}={value} is neither true nor false")
        return [flag] * _TRUTH[value.lower()]


def types_of(options: type) -> dict[str, Any]:
    """Return the type of every option by name, from a dataclass of options."""
    return {option.name: option.type for option in options_of(options)}


def overrides(
    words: Iterable[str], options: Mapping[str, Any], wrong: type[UserError]
) -> list[str]:
    """Return a command line as Hydra takes it, `name=value` for every option.

    Args:
        words: The command line, without the program.
        options: Type of every option by name.
        wrong: Exception to raise if a word is no option.

    Raises:
        UserError: As `wrong`; the message lists the options.
    """
    given: dict[str, list[str]] = {}
    tasks: list[str] = []
    waiting = ""  # name of the flag whose value comes, or further ones
    for word in words:
        name, equals, value = word.removeprefix("--").partition("=")
        is_flag = word.startswith("--")
        name = name.replace("-", "_") if is_flag else name
        if is_flag or (equals and (name in options or not waiting)):
            if name not in options:
                raise wrong(_unknown(word, name, options))
            given[name] = [value] if equals else []
            waiting = "" if equals else name
        elif not waiting or (options[waiting] is bool and word.lower() not in _TRUTH):
            tasks.append(word)
        else:
            given[waiting].append(word)
            waiting = waiting if _is_list(options[waiting]) else ""
    if tasks:
        given["task"] = [*tasks, *given.get("task", [])]
    return [f"{name}={_hydra(name, given[name], options, wrong)}" for name in given]


def why_refused(error: Exception) -> str:
    """Return in a line why Hydra took no command line, with the option that it is about."""
    cause = error.__cause__ or error
    option, reason = getattr(cause, "full_key", None), str(cause).strip().splitlines()[0]
    return f"{option}: {reason}" if option else reason


def _unknown(word: str, name: str, options: Mapping[str, Any]) -> str:
    near = difflib.get_close_matches(name, options, n=1)
    hint = f" Did you mean '{near[0]}='?" if near else ""
    return f"'{word}' is no option.{hint} Options (name=value): {', '.join(options)}"


def _hydra(
    name: str, values: Sequence[str], options: Mapping[str, Any], wrong: type[UserError]
) -> str:
    """Return the values of an option as one that Hydra reads."""
    kind = options[name]
    if not values:
        if kind is bool:
            return "true"
        raise wrong(f"--{name} needs a value: --{name} VALUE or {name}=VALUE")
    if not _is_list(kind) or values[0].startswith("{"):
        return _quoted(values[0]) if _is_text(kind) else values[0]
    split = [item for value in values for item in _split(value)]
    if not split or (kind is Any and len(split) == 1 and not _bracketed(values[0])):
        return values[0]
    return f"[{','.join(split)}]"


def _quoted(text: str) -> str:
    return text if _PLAIN.fullmatch(text) else "'" + text.replace("'", r"\'") + "'"


def _is_list(kind: Any) -> bool:
    return kind is Any or get_origin(kind) is tuple


def _is_text(kind: Any) -> bool:
    return str in (kind, *get_args(kind))


def _takes_several(action: argparse.Action) -> bool:
    return action.nargs not in (None, 0, "?")


def _values(action: argparse.Action, text: str) -> list[str]:
    """Return what a word says; a comma in a path is a part of it."""
    return [text] if action.type is Path and not _bracketed(text) else _split(text)


def _split(text: str) -> list[str]:
    inside = text[1:-1] if _bracketed(text) else text
    return [item.strip() for item in inside.split(",") if item.strip()]


def _bracketed(text: str) -> bool:
    return text.startswith("[") and text.endswith("]")
