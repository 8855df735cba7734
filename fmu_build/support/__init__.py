"""Shared by all rooms: errors, the description of a model, requests and results of builds."""
