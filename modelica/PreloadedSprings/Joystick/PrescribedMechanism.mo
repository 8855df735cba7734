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
  Interfaces.Signals.TorqueOutput T_friction "Share of the torque that overcomes dry friction, zero at rest"
    annotation (Placement(transformation(extent = {{200, -30}, {220, -10}}),
      iconTransformation(extent = {{100, -86}, {114, -72}})));
  Interfaces.Signals.TorqueOutput T_band "Half the width of the band of torques that hold at rest, zero in motion"
    annotation (Placement(transformation(extent = {{200, -50}, {220, -30}}),
      iconTransformation(extent = {{100, -102}, {114, -88}})));
  Friction.Prescribed friction(final a = a, final b = b) "Dry friction of the pivot and of the plungers"
    annotation (Placement(transformation(extent = {{100, -50}, {140, -10}})));
protected
  PrescribedAngle motion "Motion from outside"
    annotation (Placement(transformation(extent = {{-160, -90}, {-120, -50}})));
equation
  assert(noEvent(abs(theta) < theta_limit),
    getInstanceName() + ".theta must stay between -pi/2 and pi/2, but is " + String(theta) + " rad");
  T_inertia = handle.flange.tau;
  T_stiffness = camPlate.M_s - gravity.M_g;
  friction.omega = omega;
  friction.isForwardInContact = forward.returnSpring.isEngaged;
  friction.isBackwardInContact = backward.returnSpring.isEngaged;
  connect(friction.flange, handle.flange)
    annotation (Line(points = {{100, -30}, {70, -30}, {70, -20}, {-80, -20}, {-80, 110}, {-30, 110}},
      color = {64, 64, 64}));
  connect(friction.M_f, T_friction)
    annotation (Line(points = {{142, -20}, {210, -20}}, color = {0, 0, 127}));
  connect(friction.M_band, T_band)
    annotation (Line(points = {{142, -40}, {210, -40}}, color = {0, 0, 127}));
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
      Text(extent = {{-98, 72}, {-58, 48}}, textColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{-98, 12}, {-58, -12}}, textColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{-98, -48}, {-58, -72}}, textColor = {0, 0, 127}, textString = "alpha"),
      Text(extent = {{62, 72}, {98, 48}}, textColor = {0, 0, 127}, textString = "T"),
      Text(extent = {{62, 30}, {98, 10}}, textColor = {0, 0, 127}, textString = "inertia"),
      Text(extent = {{62, -10}, {98, -30}}, textColor = {0, 0, 127}, textString = "damping"),
      Text(extent = {{62, -50}, {98, -70}}, textColor = {0, 0, 127}, textString = "stiffness"),
      Text(extent = {{62, -73}, {98, -86}}, textColor = {0, 0, 127}, textString = "friction"),
      Text(extent = {{62, -88}, {98, -101}}, textColor = {0, 0, 127}, textString = "band")}),
    Diagram(coordinateSystem(extent = {{-220, -220}, {220, 220}}), graphics = {
      Line(points = {{200, 110}, {30, 110}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, 126}, {190, 114}}, textColor = {64, 64, 64}, textString = "torque on the handle"),
      Line(points = {{200, -102}, {46, -102}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, -86}, {190, -98}}, textColor = {64, 64, 64}, textString = "M_s - M_g"),
      Text(extent = {{-210, -190}, {-150, -202}}, textColor = {64, 64, 64}, textString = "dashed line: equation")}),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Joystick.JoystickInverse\">JoystickInverse</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickInversePowerLaw\">JoystickInversePowerLaw</a> have in common. A
model that extends this adds a component <code>damping</code> that is a
<a href=\"modelica://PreloadedSprings.Interfaces.DampingLaw\">damping law</a>, gives it the angular velocity
<code>omega</code> and the side <code>camPlate.isForward</code>, and connects it to the shaft
<code>handle.flange</code> and to the output <code>T_damping</code>.</p>
</html>"));
end PrescribedMechanism;
