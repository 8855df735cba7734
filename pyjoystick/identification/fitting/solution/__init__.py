"""The solution of a fit: the minimum and its uncertainty."""
