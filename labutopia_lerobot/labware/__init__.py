"""Things on the bench: glassware, instruments, soft bodies, and the parts they are made of."""
