"""From the rows of results to tables and to a page; knows nothing of how rows are made."""
