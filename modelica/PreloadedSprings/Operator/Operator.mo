within PreloadedSprings.Operator;
model Operator "Operator who moves the joystick forward and back: motion in, torque out"
  Interfaces.Signals.AngleInput theta(start = 0) "Angle of the joystick"
    annotation (Placement(transformation(extent = {{-220, -30}, {-200, -10}}),
      iconTransformation(extent = {{-120, 30}, {-100, 50}})));
  Interfaces.Signals.AngularVelocityInput omega(start = 0) "Angular velocity of the joystick"
    annotation (Placement(transformation(extent = {{-220, -80}, {-200, -60}}),
      iconTransformation(extent = {{-120, -50}, {-100, -30}})));
  Interfaces.Signals.TorqueOutput T "Torque on the joystick"
    annotation (Placement(transformation(extent = {{200, -10}, {220, 10}}),
      iconTransformation(extent = {{100, 50}, {120, 70}})));
  Interfaces.Signals.AngleOutput theta_ref "Wanted angle"
    annotation (Placement(transformation(extent = {{200, 70}, {220, 90}}),
      iconTransformation(extent = {{100, 10}, {120, 30}})));
  Interfaces.Signals.AngularVelocityOutput omega_ref "Wanted angular velocity"
    annotation (Placement(transformation(extent = {{200, 40}, {220, 60}}),
      iconTransformation(extent = {{100, -30}, {120, -10}})));
  Interfaces.Signals.EnergyOutput W(start = 0, fixed = true) "Work done on the joystick"
    annotation (Placement(transformation(extent = {{200, -110}, {220, -90}}),
      iconTransformation(extent = {{100, -70}, {120, -50}})));
  MinimumJerkMove move(theta_target = 15*Constants.pi/180, start_time = 0.1, move_time = 0.3, pause = 0.2)
    "Wanted motion"
    annotation (Placement(transformation(extent = {{-140, 40}, {-80, 100}})));
  HandArm handArm "Hand and arm"
    annotation (Placement(transformation(extent = {{-30, -60}, {90, 60}})));
equation
  der(W) = T*omega;
  connect(move.theta, handArm.theta_ref)
    annotation (Line(points = {{-77, 82}, {-50, 82}, {-50, 48}, {-36, 48}}, color = {0, 0, 127}));
  connect(move.omega, handArm.omega_ref)
    annotation (Line(points = {{-77, 58}, {-60, 58}, {-60, 18}, {-36, 18}}, color = {0, 0, 127}));
  connect(move.theta, theta_ref)
    annotation (Line(points = {{-77, 82}, {60, 82}, {60, 80}, {210, 80}}, color = {0, 0, 127}));
  connect(move.omega, omega_ref)
    annotation (Line(points = {{-77, 58}, {-66, 58}, {-66, 70}, {140, 70}, {140, 50}, {210, 50}}, color = {0, 0, 127}));
  connect(theta, handArm.theta)
    annotation (Line(points = {{-210, -20}, {-120, -20}, {-120, -18}, {-36, -18}}, color = {0, 0, 127}));
  connect(omega, handArm.omega)
    annotation (Line(points = {{-210, -70}, {-60, -70}, {-60, -48}, {-36, -48}}, color = {0, 0, 127}));
  connect(handArm.T, T)
    annotation (Line(points = {{96, 0}, {210, 0}}, color = {0, 0, 127}));

  annotation (
    defaultComponentName = "operator_",
    __pyjoystick(terminals(hand(outflow(tau = "T"), signal(phi = "theta", w = "omega")))),
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-28, 76}, {8, 40}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-10, 40}, {-10, -30}, {-34, -76}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{-10, -30}, {14, -76}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{-10, 22}, {16, -6}, {46, 10}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{46, 20}, {54, -44}}, color = {160, 60, 40}, thickness = 1),
      Text(extent = {{-96, 50}, {-54, 30}}, textColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{-96, -30}, {-54, -50}}, textColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{70, 70}, {98, 50}}, textColor = {0, 0, 127}, textString = "T"),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Diagram(coordinateSystem(extent = {{-220, -120}, {220, 120}})),
    experiment(StartTime = 0, StopTime = 1.2, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>A <a href=\"modelica://PreloadedSprings.Operator.HandArm\">hand and arm</a> whose rest position makes a
<a href=\"modelica://PreloadedSprings.Operator.MinimumJerkMove\">move</a> forward, pauses and returns. Connect
<code>T</code> to the torque of a <a href=\"modelica://PreloadedSprings.Joystick.Joystick\">joystick</a>, and its
angle and angular velocity to <code>theta</code> and <code>omega</code>, as
<a href=\"modelica://PreloadedSprings.Examples.OperatedJoystick\">OperatedJoystick</a> does.</p>
<p><code>W</code> is the work that the torque has done since the start: the integral of <code>T*omega</code>.</p>
</html>"));
end Operator;
