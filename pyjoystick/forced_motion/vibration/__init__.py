"""Response of a handle to vibration of its base, alone and in a hand."""
