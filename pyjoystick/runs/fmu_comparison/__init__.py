"""Two FMUs of the same model compared, as when they come from different compilers."""
