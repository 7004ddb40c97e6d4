"""Policies that run in another process or on another machine.

remote_policy   which server, how to ask it, and what to do while it does not answer
lerobot_server  a client of LeRobot's policy server (gRPC)
openpi_server   a client of openpi's servers (websocket)
"""
