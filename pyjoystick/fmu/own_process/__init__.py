"""FMUs that this project did not make, each in a process that may crash, hang, print or exit as it likes.

`process` starts `child` there, which carries out what `service` offers. `pool` keeps such processes, and
`runner` has them do the runs of a plan.
"""
