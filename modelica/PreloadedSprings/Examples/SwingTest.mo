within PreloadedSprings.Examples;
model SwingTest "Moment of inertia from the swing of the inverted handle (section 3.2)"
  extends Icons.Example;
  parameter Units.Angle amplitude = 3*Constants.pi/180 "Angle from which the inverted handle is released";
  Units.Angle theta(start = Constants.pi - amplitude, fixed = true) "Angle of the handle, 180 degrees where it hangs";
  Units.AngularVelocity omega(start = 0, fixed = true) "Angular velocity";
  discrete Units.Time passage(start = 0, fixed = true) "Time at which the handle last passed the bottom";
  Integer passages(start = 0, fixed = true) "How often the handle has passed the bottom in the same direction";
  discrete Units.Frequency f_n(start = 0, fixed = true) "Frequency of the swing, zero before it is known";
  discrete Units.MomentOfInertia J_swing(min = 0, start = 0, fixed = true)
    "Moment of inertia from the frequency, zero before it is known";
  Joystick.Handle handle(J = 0.01135) "Inertia of the handle"
    annotation (Placement(transformation(extent = {{0, 20}, {60, 80}})));
  Joystick.Gravity gravity(m = 0.87, h = 0.082) "Weight of the handle"
    annotation (Placement(transformation(extent = {{0, -80}, {60, -20}})));
equation
  theta = handle.flange.phi;
  der(theta) = omega;
  handle.omega = omega;
  handle.alpha = der(omega);
  when theta > Constants.pi then
    passage = time;
    passages = pre(passages) + 1;
    f_n = if pre(passages) > 0 then 1/(time - pre(passage)) else 0;
    J_swing = if pre(passages) > 0 then gravity.m*gravity.g*gravity.h/(2*Constants.pi*f_n)^2 else 0;
  end when;
  connect(handle.flange, gravity.flange)
    annotation (Line(points = {{0, 50}, {-40, 50}, {-40, -50}, {0, -50}}, color = {64, 64, 64}));

  annotation (
    experiment(StartTime = 0, StopTime = 5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The paper measures the moment of inertia by turning the joystick upside down, supporting it at the pivot and timing
its swing: <code>J = m*g*h/(2*pi*f_n)^2</code>. Here the swing is computed. Compare <code>J_swing</code> with
<code>handle.J</code>: their relative difference is only <code>amplitude^2/8</code>, because a pendulum is not exactly
linear. The frequency <code>f_n</code> is about 1.25 Hz.</p>
</html>"));
end SwingTest;
