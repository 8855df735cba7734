within PreloadedSprings.Joystick;
model Joystick "Joystick with constant damping: torque in, motion out (eq. 1)"
  extends PreloadedSprings.Joystick.Mechanism;
  parameter PreloadedSprings.Units.Angle theta_start = 0 "Angle at the start";
  parameter PreloadedSprings.Units.AngularVelocity omega_start = 0 "Angular velocity at the start";
  replaceable PreloadedSprings.Damping.Constant damping
    constrainedby PreloadedSprings.Interfaces.DampingLaw "Damping law";
  PreloadedSprings.Interfaces.Signals.TorqueInput T(start = 0) "Torque applied about the pivot";
  PreloadedSprings.Interfaces.Signals.AngleOutput theta(start = theta_start, fixed = true, stateSelect = StateSelect.always) "Angle, positive forward";
  PreloadedSprings.Interfaces.Signals.AngularVelocityOutput omega(start = omega_start, fixed = true, stateSelect = StateSelect.always) "Angular velocity";
  PreloadedSprings.Interfaces.Signals.AngularAccelerationOutput alpha "Angular acceleration";
  PreloadedSprings.Interfaces.Signals.PositionOutput x "Travel of the contact, positive for any angle";
  PreloadedSprings.Interfaces.Signals.ForceOutput f_x "Contact force";
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_s "Moment of the contact force";
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_d "Damping moment";
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_g "Moment of the weight";
  PreloadedSprings.Interfaces.Signals.RotationalDampingOutput C "Damping coefficient";
  PreloadedSprings.Interfaces.Signals.EnergyOutput E "Energy, zero at rest in the middle";
protected
  constant PreloadedSprings.Units.Angle theta_limit = PreloadedSprings.Constants.pi/2 "Angle at which the handle lies flat";
equation
  der(theta) = omega;
  der(omega) = alpha;
  handle.theta = theta;
  handle.omega = omega;
  handle.alpha = alpha;
  damping.omega = omega;
  E = handle.E + gravity.E + forward.E + backward.E;
  connect(T, drive.T);
  connect(damping.flange, camPlate.flange);
  connect(camPlate.isForward, damping.isForward);
  connect(camPlate.x, x);
  connect(camPlate.f_x, f_x);
  connect(camPlate.M_s, M_s);
  connect(damping.M_d, M_d);
  connect(damping.coefficient, C);
  connect(gravity.M_g, M_g);
initial equation
  assert(theta_start > -theta_limit and theta_start < theta_limit,
    getInstanceName() + ".theta_start must be between -pi/2 and pi/2, but is " + String(theta_start) + " rad");
end Joystick;
