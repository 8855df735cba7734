"""Damping from the peaks of free oscillations (section 3.3 of the paper), and its bias."""
