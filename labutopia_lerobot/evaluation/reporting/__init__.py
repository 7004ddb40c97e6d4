"""Tables and pages from the rows of results; knows nothing of how rows are made.

table           a table as a value, and as text, Markdown, CSV, LaTeX
paper           the paper's own numbers
report_entry    which rows stand together: one policy under one condition
result_tables   tables by level as the paper's, of failures, of precision
run_tables      what a run prints when it is over
page, charts    one HTML file with everything, films included
leaderboard     the page of all submissions
"""
