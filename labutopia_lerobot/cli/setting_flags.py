"""The fields of `Setting` as flags of a program."""

import argparse
from dataclasses import fields
from typing import Any

from labutopia_lerobot.setting import Setting, option_help, setting_from


def add_setting_flags(parser: argparse.ArgumentParser, **defaults: Any) -> None:
    """Give a program a flag `--name` for every field of `Setting` but the task.

    Args:
        parser: Of the program.
        **defaults: Fields whose default is another one in this program.
    """
    helps = option_help(Setting)
    for option in fields(Setting):
        if option.name == "task":
            continue
        default = defaults.get(option.name, option.default)
        several = isinstance(option.default, tuple)
        shown = " ".join(default) or "none" if several else default
        parser.add_argument(
            f"--{option.name.replace('_', '-')}",
            type=int if option.type is int else str,
            nargs="+" if several else None,
            default=default,
            help=f"{helps[option.name]} (default: {shown})".replace("%", "%%"),
        )


def setting_of_flags(arguments: argparse.Namespace, task: str, **chosen: Any) -> Setting:
    """Return the setting that the flags describe.

    Args:
        arguments: What the parser found.
        task: Task id.
        **chosen: Fields that take other values than the flags'.

    Raises:
        UnknownOptionError: If a value is impossible.
        UnknownTaskError: If there is no such task.
    """
    values = {option.name: getattr(arguments, option.name, None) for option in fields(Setting)}
    return setting_from(values | {"task": task} | chosen)
