"""What a browser shows: what the server draws, it shows; nothing is loaded from elsewhere.

episodes           what can be shown: an expert's episodes, by seed
recorded_episodes  or those of a dataset
orbit              a camera that turns about a point
showing            plays episodes and publishes moments: picture, steps, facts, readings
episodes_site      the site that shows them: `page.html`, and what its buttons say
results_site       that of an evaluation's results and films
server             serves a site on loopback, and takes its commands
"""
