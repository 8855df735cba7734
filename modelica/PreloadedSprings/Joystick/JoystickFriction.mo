within PreloadedSprings.Joystick;
model JoystickFriction "Joystick with dry friction and constant damping: torque in, motion out"
  extends RubbingMechanism;
  replaceable Damping.Constant damping
    constrainedby Interfaces.DampingLaw "Damping law"
    annotation (choicesAllMatching = true, Placement(transformation(extent = {{-30, -10}, {30, 50}})));
equation
  damping.omega = omega;
  connect(T, drive.T)
    annotation (Line(points = {{-210, 0}, {-162, 0}}, color = {0, 0, 127}));
  connect(damping.flange, handle.flange)
    annotation (Line(points = {{-30, 20}, {-80, 20}, {-80, 110}, {-30, 110}}, color = {64, 64, 64}));
  connect(camPlate.isForward, damping.isForward)
    annotation (Line(points = {{0, -26}, {0, -13}}, color = {255, 0, 255}));
  connect(damping.coefficient, C)
    annotation (Line(points = {{33, 35}, {210, 35}}, color = {0, 0, 127}));
  connect(damping.M_d, M_d)
    annotation (Line(points = {{33, 5}, {210, 5}}, color = {0, 0, 127}));

  annotation (
    defaultComponentName = "joystick",
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p><a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a> with dry friction of its pivot and plungers,
which the paper does not have:</p>
<blockquote><code>J*alpha + C*omega + M_f + M_s = m*g*h*sin(theta) + T</code>.</blockquote>
<p>The joystick sticks where the friction can balance all other moments (<code>isStuck</code>), and stays exactly
where it is until they exceed the static friction. While it slides, the friction moment <code>M_f</code> acts
against the motion: Coulomb friction <code>friction.T_c</code> at the pivot and <code>friction.F_c</code> along the
plunger in contact, and optionally Stribeck friction with <code>friction.T_s</code> and
<code>friction.omega_s</code>; see
<a href=\"modelica://PreloadedSprings.Interfaces.DryFriction\">Interfaces.DryFriction</a>. All four are zero by preset,
and the motion is then that of Joystick.</p>
<p>Without a torque the energy falls by <code>dE/dt = -C*omega^2 - M_f*omega</code>. Where friction
prevails, a free oscillation ends after a finite time; where damping does, it decays exponentially.</p>
<p>State events are those of Joystick and the changes of <code>friction.mode</code>: 1 and -1 while it slides forward
and backward, 0 while it is stuck.</p>
</html>"));
end JoystickFriction;
