"""Mutation trials, which show errors that the tests would not detect."""
