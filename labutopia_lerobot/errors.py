"""Mistakes that a user can mend: told in one message, without a traceback."""


class UserError(Exception):
    """Names the thing that is wrong, lists the choices or the cure. Programs exit with status 2."""
