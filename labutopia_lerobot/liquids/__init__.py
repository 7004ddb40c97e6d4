"""Liquids: particles between MuJoCo and their solver, the account of them, their drawing."""
