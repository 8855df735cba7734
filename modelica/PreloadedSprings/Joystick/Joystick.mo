within PreloadedSprings.Joystick;
model Joystick "Joystick with constant damping: torque in, motion out (eq. 1)"
  extends DrivenMechanism;
  replaceable Damping.Constant damping
    constrainedby Interfaces.DampingLaw "Damping law"
    annotation (choicesAllMatching = true, Placement(transformation(extent = {{-30, -10}, {30, 50}})));
equation
  handle.alpha = alpha;
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
<p>The paper's joystick under a torque <code>T</code> about its pivot, eq. (1) with the torque of eq. (13):</p>
<blockquote><code>J*alpha + C*omega + M_s = m*g*h*sin(theta) + T</code>.</blockquote>
<p>The angle <code>theta</code> is zero in the neutral position and positive forward; it must stay between -90
and 90 degrees. (The real joystick's stops are at about 20 degrees to either side;
<a href=\"modelica://PreloadedSprings.Operator.MountedJoystick\">Operator.MountedJoystick</a> has them.) The two
states are <code>theta</code> and <code>omega</code>, which start from <code>theta_start</code> and
<code>omega_start</code>. The preset values are those of the paper's Tables 1 and 2.</p>
<p>The energy <code>E = J*omega^2/2 + m*g*h*(cos(theta) - 1)</code> plus that of the springs is computed from
the state, not integrated. Without a torque it changes by <code>dE/dt = -C*omega^2</code> (Fig. 12).</p>
<p>State events are the changes of the sign of <code>theta</code> and, on either side, of the contact state of
the two springs: the beginnings <code>x_0</code> to <code>x_3</code> of the segments of Table 1.</p>
<p>What is connected to the <code>flange</code>, such as a motor or a load, adds its torque and its moment of inertia.
<code>E</code> is the energy of the joystick alone.</p>
<p>The damping law can be replaced:
<code>Joystick(redeclare PreloadedSprings.Damping.PowerLaw damping)</code>.</p>
</html>"));
end Joystick;
