"""Foreign FMUs, each in its own process, which may crash, hang, print or exit.

`process` starts `child` there, which executes the requests defined in `service`. `pool` keeps such processes,
and `runner` makes them execute the runs of a plan.
"""
