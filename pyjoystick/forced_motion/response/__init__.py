"""Response to a sinusoidal torque: periodic motions, their branches, and chaos."""
