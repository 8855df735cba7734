"""Several FMUs as one system: its description, SSP archives, and a master that runs it by co-simulation."""
