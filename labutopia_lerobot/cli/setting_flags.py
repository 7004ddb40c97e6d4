"""The fields of `Setting` as flags of a program."""

import argparse
from collections.abc import Collection
from dataclasses import fields
from functools import partial
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenario.own_files import OwnFiles
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import Setting, option_help, setting_from


def add_setting_flags(
    parser: argparse.ArgumentParser, but: Collection[str] = (), **defaults: Any
) -> None:
    """Give a program a flag `--name` for every field of `Setting` but the task.

    Args:
        parser: Of the program.
        but: Fields that the program chooses itself.
        **defaults: Fields whose default is another one in this program.
    """
    helps = option_help(Setting)
    for option in fields(Setting):
        if option.name in ("task", *but):
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


def add_own_files(parser: argparse.ArgumentParser) -> None:
    """Give a program that plays datasets flags for the files that they were recorded with."""
    parser.add_argument(
        "--room",
        type=partial(_read, "room"),
        metavar="FILE.json",
        help="the room of a dataset that was recorded in one of somebody's own",
    )
    parser.add_argument(
        "--reasoner",
        type=partial(_read, "reasoner"),
        metavar="FILE.json",
        help="a language model's answers, of a dataset in which they decided what reacts",
    )


def _read(kind: str, file: str) -> str:
    try:
        OwnFiles(**{kind: file}).read()
    except UserError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return file


def setting_of_flags(arguments: argparse.Namespace, task: str, **chosen: Any) -> Setting:
    """Return the setting that the flags describe.

    Args:
        arguments: The parsed command line.
        task: Task id.
        **chosen: Fields that take other values than the flags'.

    Raises:
        UnknownOptionError: If a value is impossible.
        UnknownRoomError: If there is no such room.
        UnknownTaskError: If there is no such task.
    """
    names = (option.name for option in fields(Setting))
    values = {name: getattr(arguments, name) for name in names if hasattr(arguments, name)}
    setting = setting_from(values | {"task": task} | chosen)
    load_room(setting.room)  # it must be one that can be played in
    return setting
