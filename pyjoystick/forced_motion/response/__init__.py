"""What a joystick does whose handle is shaken: periodic motions, their branches, and chaos."""
