within PreloadedSprings.Joystick;
partial model PrescribedMechanism "Mechanism that is led through a motion: the inverse joystick without its damping law"
  extends Mechanism;
  Interfaces.Signals.AngleInput theta(start = 0) "Angle from the neutral position, positive forward"
    annotation (Placement(transformation(extent = {{-220, -80}, {-200, -60}}),
      iconTransformation(extent = {{-120, 50}, {-100, 70}})));
  Interfaces.Signals.AngularVelocityInput omega(start = 0) "Angular velocity"
    annotation (Placement(transformation(extent = {{-220, 55}, {-200, 75}}),
      iconTransformation(extent = {{-120, -10}, {-100, 10}})));
  Interfaces.Signals.AngularAccelerationInput alpha(start = 0) "Angular acceleration"
    annotation (Placement(transformation(extent = {{-220, 140}, {-200, 160}}),
      iconTransformation(extent = {{-120, -70}, {-100, -50}})));
  Interfaces.Signals.TorqueOutput T "Torque about the pivot that the motion needs, towards positive angles"
    annotation (Placement(transformation(extent = {{200, -160}, {220, -140}}),
      iconTransformation(extent = {{100, 50}, {120, 70}})));
  Interfaces.Signals.TorqueOutput T_inertia "Share of the torque that accelerates the handle, J*alpha"
    annotation (Placement(transformation(extent = {{200, 100}, {220, 120}}),
      iconTransformation(extent = {{100, 10}, {120, 30}})));
  Interfaces.Signals.TorqueOutput T_damping "Share of the torque that overcomes the damping, C*omega"
    annotation (Placement(transformation(extent = {{200, -5}, {220, 15}}),
      iconTransformation(extent = {{100, -30}, {120, -10}})));
  Interfaces.Signals.TorqueOutput T_stiffness
    "Share of the torque that holds springs and weight, M_s - m*g*h*sin(theta)"
    annotation (Placement(transformation(extent = {{200, -112}, {220, -92}}),
      iconTransformation(extent = {{100, -70}, {120, -50}})));
protected
  PrescribedAngle motion "Motion from outside"
    annotation (Placement(transformation(extent = {{-160, -90}, {-120, -50}})));
equation
  assert(noEvent(abs(theta) < theta_limit),
    getInstanceName() + ".theta must stay between -pi/2 and pi/2, but is " + String(theta) + " rad");
  T_inertia = handle.flange.tau;
  T_stiffness = camPlate.M_s - gravity.M_g;
  connect(theta, motion.theta)
    annotation (Line(points = {{-210, -70}, {-162, -70}}, color = {0, 0, 127}));
  connect(motion.flange, handle.flange)
    annotation (Line(points = {{-120, -70}, {-80, -70}, {-80, 110}, {-30, 110}}, color = {64, 64, 64}));
  connect(omega, handle.omega)
    annotation (Line(points = {{-210, 65}, {0, 65}, {0, 77}}, color = {0, 0, 127}));
  connect(alpha, handle.alpha)
    annotation (Line(points = {{-210, 150}, {0, 150}, {0, 143}}, color = {0, 0, 127}));
  connect(motion.T, T)
    annotation (Line(points = {{-140, -92}, {-140, -210}, {140, -210}, {140, -150}, {210, -150}}, color = {0, 0, 127}));

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{-98, 72}, {-58, 48}}, lineColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{-98, 12}, {-58, -12}}, lineColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{-98, -48}, {-58, -72}}, lineColor = {0, 0, 127}, textString = "alpha"),
      Text(extent = {{62, 72}, {98, 48}}, lineColor = {0, 0, 127}, textString = "T"),
      Text(extent = {{62, 30}, {98, 10}}, lineColor = {0, 0, 127}, textString = "inertia"),
      Text(extent = {{62, -10}, {98, -30}}, lineColor = {0, 0, 127}, textString = "damping"),
      Text(extent = {{62, -50}, {98, -70}}, lineColor = {0, 0, 127}, textString = "stiffness")}),
    Diagram(coordinateSystem(extent = {{-220, -220}, {220, 220}}), graphics = {
      Line(points = {{200, 110}, {30, 110}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, 126}, {190, 114}}, lineColor = {64, 64, 64}, textString = "torque on the handle"),
      Line(points = {{200, -102}, {46, -102}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, -86}, {190, -98}}, lineColor = {64, 64, 64}, textString = "M_s - M_g"),
      Text(extent = {{-210, -190}, {-150, -202}}, lineColor = {64, 64, 64}, textString = "dashed line: equation")}),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Joystick.JoystickInverse\">JoystickInverse</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickInversePowerLaw\">JoystickInversePowerLaw</a> have in common. A
model that extends this adds a component <code>damping</code> that is a
<a href=\"modelica://PreloadedSprings.Interfaces.DampingLaw\">damping law</a>, gives it the angular velocity
<code>omega</code> and the side <code>camPlate.isForward</code>, and connects it to the shaft
<code>handle.flange</code> and to the output <code>T_damping</code>.</p>
</html>"));
end PrescribedMechanism;
