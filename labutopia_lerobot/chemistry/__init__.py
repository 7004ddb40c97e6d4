"""A chemical engine: substances, what happens when they meet, and what one would see.

It imports neither mujoco nor torch. Paper: "Chemical Process Modeling" and its appendix ("Database
of Chemical Substances", "Process Reasoning Pipeline").
"""
