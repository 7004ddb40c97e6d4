"""Uncertainty of numbers from finitely many episodes; knows nothing of rows.

intervals   of rates and medians for a fixed number of episodes, and what a precision costs
paired      two policies on common seeds: exact test, difference, Holm's adjustment
anytime     what stays valid however often one looks, and whenever one stops
"""
