within PreloadedSprings.Joystick;
model JoystickPowerLaw "Joystick with the damping law of eq. (11): torque in, motion out"
  extends PreloadedSprings.Joystick.Joystick(redeclare PreloadedSprings.Damping.PowerLaw damping);
end JoystickPowerLaw;
