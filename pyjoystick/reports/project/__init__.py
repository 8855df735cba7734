"""Projects: folders with a laboratory's files, from which one command identifies the joystick."""
