"""Fitting an FMU's parameters to records, and saying how sure the answer is."""
