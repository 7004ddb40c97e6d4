"""Evaluation: policies are played, their episodes become rows, rows become numbers with intervals.

What is played
    config              options of the evaluator
    condition           all that decides an episode but its seed and the policy: the key of numbers
    jobs                from options to jobs: one policy under one condition

Who plays
    policies            the protocol; expert, random, still; a policy per step; recorded actions
    find_checkpoint     where a trained policy lies, here or on the Hub
    checkpoint_security what its files may not do, read before LeRobot reads them
    checkpoint          what it observes, and whether it fits the task
    learned_policy      LeRobot's policy, loaded and asked; imports torch
    remote/             policies on servers: LeRobot's over gRPC, openpi's over a websocket

Playing
    run                 a run: plays what is missing, writes the result, prints the tables
    rollout             one episode, and its film
    precision           errors of places and volumes at the end, beside success
    logged_vector       environments of LeRobot's training that log each task's success
    journey             what was driven: way, shortest way, SPL
    failure_causes      why an episode failed, in one phrase
    stopping            when enough episodes are played (`until=`, `versus=`)

What remains
    rows                one row per episode, one summary per condition
    result_folder       the folder of a result, written so that a killed run goes on
    origin              what rows come from: options, code, versions, weights
    load_results        results that lie in folders, finished or not
    submission          a result packed for the leaderboard, checked and played again

What it means
    uncertainty/        intervals, tests, sequences that stay valid whenever one stops
    compare             two policies on common seeds
    reporting/          tables, the page, the leaderboard; knows nothing of how rows are made

What it means needs rows only, and nothing that plays them.
"""
