"""Records of measured motions: reading them from files, and what is refused or flagged in them."""
