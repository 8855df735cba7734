"""The minimum of a fit, and how sure it is."""
