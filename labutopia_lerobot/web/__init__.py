"""A viewer in the browser: what the server draws, it shows; nothing is loaded from elsewhere.

episodes           what can be shown: an expert's episodes, by seed
recorded_episodes  or those of a dataset
orbit              a camera that turns about a point
showing            plays episodes and publishes moments: picture, steps, facts, readings
server             hands them out on loopback, and takes what the page's buttons say
page.html          the page
"""
