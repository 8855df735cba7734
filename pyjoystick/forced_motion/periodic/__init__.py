"""Periodic solutions of any system as fixed points of a map: shooting, continuation, stability, chaos."""
