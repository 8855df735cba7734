"""Coupled systems of FMUs: description, SSP archives, and a co-simulation master."""
