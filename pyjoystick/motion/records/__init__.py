"""Records of measured motions: reading them from files, and checks."""
