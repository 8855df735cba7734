"""Fitting an FMU's parameters to records, with uncertainties and checks."""
