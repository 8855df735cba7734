within PreloadedSprings.Damping;
model PowerLaw "Damping coefficient from powers of angle and angular velocity (eq. 11)"
  extends Interfaces.DampingLaw;
  parameter Units.Ratio alpha(min = 0, max = 1) = 0.9 "Weight of the angle's share";
  final parameter Units.Ratio beta = 1 - alpha "Weight of the angular velocity's share";
  parameter Units.RotationalDamping A_pos = 0.086 "Coefficient at 1 rad";
  parameter Units.Ratio n_pos = 0.084 "Exponent of the angle where it is positive";
  parameter Units.RotationalDamping A_neg = 0.032 "Coefficient at -1 rad";
  parameter Units.Ratio n_neg = -0.23 "Exponent of the angle where it is negative";
  parameter Units.RotationalDamping B = 0.051 "Coefficient at 1 rad/s";
  parameter Units.Ratio m = -0.26 "Exponent of the angular velocity";
  parameter Units.Angle eps_theta(min = Constants.small) = 1e-4 "Angle below which the law is smoothed";
  parameter Units.AngularVelocity eps_omega(min = Constants.small) = 1e-3
    "Angular velocity below which the law is smoothed";
protected
  Units.Angle phi_abs "Smoothed magnitude of the angle";
  Units.AngularVelocity omega_abs "Smoothed magnitude of the angular velocity";
equation
  phi_abs = sqrt(flange.phi^2 + eps_theta^2);
  omega_abs = sqrt(omega^2 + eps_omega^2);
  coefficient = alpha*(if isForward then A_pos*phi_abs^n_pos else A_neg*phi_abs^n_neg) + beta*B*omega_abs^m;
initial equation
  assert(alpha >= 0 and alpha <= 1, getInstanceName() + ".alpha must be between 0 and 1, but is " + String(alpha));
  assert(A_pos >= 0, getInstanceName() + ".A_pos must not be negative, but is " + String(A_pos) + " N.m.s/rad");
  assert(A_neg >= 0, getInstanceName() + ".A_neg must not be negative, but is " + String(A_neg) + " N.m.s/rad");
  assert(B >= 0, getInstanceName() + ".B must not be negative, but is " + String(B) + " N.m.s/rad");
  assert(eps_theta > 0, getInstanceName() + ".eps_theta must be positive, but is " + String(eps_theta) + " rad");
  assert(eps_omega > 0, getInstanceName() + ".eps_omega must be positive, but is " + String(eps_omega) + " rad/s");

  annotation (
    defaultComponentName = "damping",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{20, 56}, {20, -24}, {74, -24}}, color = {128, 128, 128}),
      Line(points = {{23, 50}, {26, 24}, {32, 8}, {42, -2}, {56, -8}, {72, -11}}, color = {160, 60, 40},
        thickness = 0.5)}),
    Documentation(info = "<html>
<p>Eq. (11) of the paper,</p>
<blockquote><code>C = alpha*A*|theta|^n + beta*B*|omega|^m</code>,&nbsp; <code>alpha + beta = 1</code>,</blockquote>
<p>with <code>A</code> and <code>n</code> of the side that the joystick is on: <code>A_pos</code>, <code>n_pos</code>
at positive angles, <code>A_neg</code>, <code>n_neg</code> at negative ones. Angles are in rad and angular
velocities in rad/s. The preset values are the paper's; its best fit is <code>alpha = 0.9</code>.</p>
<p>The exponents may be negative; the law would then be infinite at rest and in the middle. Therefore
<code>|theta|</code> means <code>sqrt(theta^2 + eps_theta^2)</code>, and <code>|omega|</code> means <code>sqrt(omega^2 +
eps_omega^2)</code>. The coefficient jumps where the angle changes its sign (Fig. 13), which is a state event.</p>
</html>"));
end PowerLaw;
