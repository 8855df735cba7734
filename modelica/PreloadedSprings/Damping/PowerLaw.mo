within PreloadedSprings.Damping;
model PowerLaw "Damping coefficient that depends on powers of angle and angular velocity (eq. 11)"
  extends PreloadedSprings.Interfaces.DampingLaw;
  parameter PreloadedSprings.Units.Ratio alpha(min = 0, max = 1) = 0.9 "Weight of the dependence on the angle";
  final parameter PreloadedSprings.Units.Ratio beta = 1 - alpha "Weight of the dependence on the angular velocity";
  parameter PreloadedSprings.Units.RotationalDamping A_pos = 0.086 "Coefficient at 1 rad for positive angles";
  parameter PreloadedSprings.Units.Ratio n_pos = 0.084 "Exponent of the angle for positive angles";
  parameter PreloadedSprings.Units.RotationalDamping A_neg = 0.032 "Coefficient at -1 rad for negative angles";
  parameter PreloadedSprings.Units.Ratio n_neg = -0.23 "Exponent of the angle for negative angles";
  parameter PreloadedSprings.Units.RotationalDamping B = 0.051 "Coefficient at 1 rad/s";
  parameter PreloadedSprings.Units.Ratio m = -0.26 "Exponent of the angular velocity";
  parameter PreloadedSprings.Units.Angle eps_theta(min = 0) = 1e-4 "Angle below which the law is smoothed";
  parameter PreloadedSprings.Units.AngularVelocity eps_omega(min = 0) = 1e-3
    "Angular velocity below which the law is smoothed";
protected
  PreloadedSprings.Units.Angle q "Smoothed magnitude of the angle";
  PreloadedSprings.Units.AngularVelocity w "Smoothed magnitude of the angular velocity";
equation
  q = sqrt(flange.phi^2 + eps_theta^2);
  w = sqrt(omega^2 + eps_omega^2);
  coefficient = alpha*(if isForward then A_pos*q^n_pos else A_neg*q^n_neg) + beta*B*w^m;
initial equation
  assert(alpha >= 0 and alpha <= 1, getInstanceName() + ".alpha must be between 0 and 1, but is " + String(alpha));
  assert(A_pos >= 0, getInstanceName() + ".A_pos must not be negative, but is " + String(A_pos) + " N.m.s/rad");
  assert(A_neg >= 0, getInstanceName() + ".A_neg must not be negative, but is " + String(A_neg) + " N.m.s/rad");
  assert(B >= 0, getInstanceName() + ".B must not be negative, but is " + String(B) + " N.m.s/rad");
  assert(eps_theta > 0, getInstanceName() + ".eps_theta must be positive, but is " + String(eps_theta) + " rad");
  assert(eps_omega > 0, getInstanceName() + ".eps_omega must be positive, but is " + String(eps_omega) + " rad/s");
end PowerLaw;
