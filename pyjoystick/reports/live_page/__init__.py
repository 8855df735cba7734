"""A live joystick in one page: that of `fmu_build explore`, with a scene, records and a parameter file."""
