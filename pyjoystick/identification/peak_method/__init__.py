"""Damping from the peaks of free oscillations: section 3.3 of the paper, with its bias."""
