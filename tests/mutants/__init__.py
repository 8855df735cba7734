"""Mutation trials: what the tests would not see if it were wrong."""
