"""Checks of whether a fit can be trusted, and of what the model may lack."""
