within PreloadedSprings.Joystick;
model JoystickInverse "Joystick with constant damping: motion in, torque out (eq. 13)"
  extends PrescribedMechanism;
  replaceable Damping.Constant damping
    constrainedby Interfaces.DampingLaw "Damping law"
    annotation (choicesAllMatching = true, Placement(transformation(extent = {{-30, -10}, {30, 50}})));
equation
  connect(damping.flange, handle.flange)
    annotation (Line(points = {{-30, 20}, {-80, 20}, {-80, 110}, {-30, 110}}, color = {64, 64, 64}));
  connect(camPlate.isForward, damping.isForward)
    annotation (Line(points = {{0, -26}, {0, -13}}, color = {255, 0, 255}));
  connect(omega, damping.omega)
    annotation (Line(points = {{-210, 65}, {0, 65}, {0, 53}}, color = {0, 0, 127}));
  connect(damping.M_d, T_damping)
    annotation (Line(points = {{33, 5}, {210, 5}}, color = {0, 0, 127}));

  annotation (
    defaultComponentName = "joystick",
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The torque that a given motion needs, eq. (13), and its shares (Fig. 15):</p>
<blockquote><code>T = T_inertia + T_damping + T_stiffness + T_friction</code>,<br>
<code>T_inertia = J*alpha</code>,&nbsp; <code>T_damping = C*omega</code>,&nbsp;
<code>T_stiffness = M_s - m*g*h*sin(theta)</code>.</blockquote>
<p>The share <code>T_friction</code> is that of the <a href=\"modelica://PreloadedSprings.Friction.Prescribed\">dry
friction</a>, which is zero with the preset values. At rest, any torque within <code>T_band</code> of <code>T</code>
holds the joystick.</p>
<p>The angle and its two derivatives are inputs; nothing is differentiated here, so filtered measurements can be
used as they are. Parameters and their preset values are those of
<a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a>, without the start values. The damping law
can be replaced.</p>
</html>"));
end JoystickInverse;
