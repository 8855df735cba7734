within PreloadedSprings.Joystick;
model JoystickInverse "Joystick with constant damping: motion in, torque out (eq. 13)"
  extends PreloadedSprings.Joystick.Mechanism;
  replaceable PreloadedSprings.Damping.Constant damping
    constrainedby PreloadedSprings.Interfaces.DampingLaw "Damping law";
  PreloadedSprings.Interfaces.Signals.AngleInput theta(start = 0) "Angle, positive forward";
  PreloadedSprings.Interfaces.Signals.AngularVelocityInput omega(start = 0) "Angular velocity";
  PreloadedSprings.Interfaces.Signals.AngularAccelerationInput alpha(start = 0) "Angular acceleration";
  PreloadedSprings.Interfaces.Signals.TorqueOutput T "Torque that the motion needs";
  PreloadedSprings.Interfaces.Signals.TorqueOutput T_inertia "Part of the torque that accelerates the handle";
  PreloadedSprings.Interfaces.Signals.TorqueOutput T_damping "Part of the torque that overcomes the damping";
  PreloadedSprings.Interfaces.Signals.TorqueOutput T_stiffness "Part of the torque that holds the handle";
equation
  drive.T = T;
  T_inertia = handle.flange.tau;
  T_stiffness = camPlate.M_s - gravity.M_g;
  connect(damping.flange, camPlate.flange);
  connect(camPlate.isForward, damping.isForward);
  connect(theta, handle.theta);
  connect(omega, handle.omega);
  connect(alpha, handle.alpha);
  connect(omega, damping.omega);
  connect(damping.M_d, T_damping);
end JoystickInverse;
