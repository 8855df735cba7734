within PreloadedSprings.Joystick;
partial model DrivenMechanism "Mechanism that a torque drives: the joystick without its damping law"
  extends Mechanism;
  parameter Units.Angle theta_start(min = -Constants.pi/2, max = Constants.pi/2) = 0 "Angle at the start"
    annotation (Dialog(group = "Start"));
  parameter Units.AngularVelocity omega_start = 0 "Angular velocity at the start"
    annotation (Dialog(group = "Start"));
  Interfaces.Signals.TorqueInput T(start = 0) "Torque applied about the pivot, towards positive angles"
    annotation (Placement(transformation(extent = {{-220, -10}, {-200, 10}}),
      iconTransformation(extent = {{-120, -10}, {-100, 10}})));
  Interfaces.Signals.AngleOutput theta(start = theta_start, fixed = true, nominal = 0.1,
    stateSelect = StateSelect.prefer) "Angle from the neutral position, positive forward"
    annotation (Placement(transformation(extent = {{200, 100}, {220, 120}}),
      iconTransformation(extent = {{100, 82}, {116, 98}})));
  Interfaces.Signals.AngularVelocityOutput omega(start = omega_start, fixed = true,
    stateSelect = StateSelect.prefer) "Angular velocity"
    annotation (Placement(transformation(extent = {{200, 55}, {220, 75}}),
      iconTransformation(extent = {{100, 62}, {116, 78}})));
  Interfaces.Signals.AngularAccelerationOutput alpha "Angular acceleration"
    annotation (Placement(transformation(extent = {{200, 140}, {220, 160}}),
      iconTransformation(extent = {{100, 42}, {116, 58}})));
  Interfaces.Signals.PositionOutput x "Travel of the contact, positive for either direction (eq. 3)"
    annotation (Placement(transformation(extent = {{200, -48}, {220, -28}}),
      iconTransformation(extent = {{100, 22}, {116, 38}})));
  Interfaces.Signals.ForceOutput f_x "Contact force along the plunger axis"
    annotation (Placement(transformation(extent = {{200, -80}, {220, -60}}),
      iconTransformation(extent = {{100, 2}, {116, 18}})));
  Interfaces.Signals.TorqueOutput M_s "Moment of the contact force (eq. 5, corrected)"
    annotation (Placement(transformation(extent = {{200, -112}, {220, -92}}),
      iconTransformation(extent = {{100, -18}, {116, -2}})));
  Interfaces.Signals.TorqueOutput M_d "Damping moment C*omega"
    annotation (Placement(transformation(extent = {{200, -5}, {220, 15}}),
      iconTransformation(extent = {{100, -38}, {116, -22}})));
  Interfaces.Signals.TorqueOutput M_g "Moment of the weight m*g*h*sin(theta)"
    annotation (Placement(transformation(extent = {{200, 170}, {220, 190}}),
      iconTransformation(extent = {{100, -58}, {116, -42}})));
  Interfaces.Signals.RotationalDampingOutput C "Damping coefficient"
    annotation (Placement(transformation(extent = {{200, 25}, {220, 45}}),
      iconTransformation(extent = {{100, -78}, {116, -62}})));
  Interfaces.Signals.EnergyOutput E "Kinetic and potential energy, zero at rest in the neutral position"
    annotation (Placement(transformation(extent = {{200, -160}, {220, -140}}),
      iconTransformation(extent = {{100, -98}, {116, -82}})));
  Interfaces.RotationalFlange flange "Shaft of the handle, to be loaded or driven"
    annotation (Placement(transformation(extent = {{-210, 100}, {-190, 120}}),
      iconTransformation(extent = {{-110, -90}, {-90, -70}})));
protected
  DrivingTorque drive "Torque from outside"
    annotation (Placement(transformation(extent = {{-160, -20}, {-120, 20}})));
equation
  assert(theta_start > -theta_limit and theta_start < theta_limit,
    getInstanceName() + ".theta_start must be between -pi/2 and pi/2, but is " + String(theta_start) + " rad");
  assert(noEvent(abs(theta) < theta_limit),
    getInstanceName() + ".theta must stay between -pi/2 and pi/2, but is " + String(theta) + " rad");
  theta = handle.flange.phi;
  der(theta) = omega;
  der(omega) = alpha;
  handle.omega = omega;
  E = handle.E + gravity.E + forward.E + backward.E;
  connect(drive.flange, handle.flange)
    annotation (Line(points = {{-120, 0}, {-80, 0}, {-80, 110}, {-30, 110}}, color = {64, 64, 64}));
  connect(flange, handle.flange)
    annotation (Line(points = {{-200, 110}, {-30, 110}}, color = {64, 64, 64}));
  connect(gravity.M_g, M_g)
    annotation (Line(points = {{22, 180}, {210, 180}}, color = {0, 0, 127}));
  connect(camPlate.x, x)
    annotation (Line(points = {{44, -38}, {210, -38}}, color = {0, 0, 127}));
  connect(camPlate.f_x, f_x)
    annotation (Line(points = {{44, -70}, {210, -70}}, color = {0, 0, 127}));
  connect(camPlate.M_s, M_s)
    annotation (Line(points = {{44, -102}, {210, -102}}, color = {0, 0, 127}));

  annotation (
    __pyjoystick(terminals(shaft(inflow(tau = "T"), signal(phi = "theta", w = "omega", a = "alpha")))),
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{-96, 18}, {-56, -18}}, textColor = {0, 0, 127}, textString = "T"),
      Text(extent = {{70, 98}, {98, 82}}, textColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{70, 78}, {98, 62}}, textColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{70, 58}, {98, 42}}, textColor = {0, 0, 127}, textString = "alpha"),
      Text(extent = {{70, 38}, {98, 22}}, textColor = {0, 0, 127}, textString = "x"),
      Text(extent = {{70, 18}, {98, 2}}, textColor = {0, 0, 127}, textString = "f_x"),
      Text(extent = {{70, -2}, {98, -18}}, textColor = {0, 0, 127}, textString = "M_s"),
      Text(extent = {{70, -22}, {98, -38}}, textColor = {0, 0, 127}, textString = "M_d"),
      Text(extent = {{70, -42}, {98, -58}}, textColor = {0, 0, 127}, textString = "M_g"),
      Text(extent = {{70, -62}, {98, -78}}, textColor = {0, 0, 127}, textString = "C"),
      Text(extent = {{70, -82}, {98, -98}}, textColor = {0, 0, 127}, textString = "E")}),
    Diagram(coordinateSystem(extent = {{-220, -220}, {220, 220}}), graphics = {
      Line(points = {{200, 150}, {0, 150}, {0, 143}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, 166}, {190, 154}}, textColor = {64, 64, 64}, textString = "d(omega)/dt"),
      Line(points = {{200, 110}, {30, 110}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, 126}, {190, 114}}, textColor = {64, 64, 64}, textString = "angle of the shaft"),
      Line(points = {{200, 65}, {0, 65}, {0, 77}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Line(points = {{0, 65}, {0, 53}}, color = {0, 0, 127}, pattern = LinePattern.Dash),
      Text(extent = {{90, 81}, {190, 69}}, textColor = {64, 64, 64}, textString = "d(theta)/dt"),
      Text(extent = {{90, -144}, {190, -156}}, textColor = {64, 64, 64}, textString = "sum of all energies"),
      Text(extent = {{-210, -190}, {-60, -202}}, textColor = {64, 64, 64}, textString = "dashed lines: equations")}),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickPowerLaw\">JoystickPowerLaw</a> have in common. A model
that extends this adds a component <code>damping</code> that is a
<a href=\"modelica://PreloadedSprings.Interfaces.DampingLaw\">damping law</a>, gives it the angular velocity
<code>omega</code> and the side <code>camPlate.isForward</code>, and connects it to the shaft
<code>handle.flange</code> and to the outputs <code>C</code> and <code>M_d</code>. It gives the torque on the shaft,
<code>drive.T</code>: that is <code>T</code>, and for a
<a href=\"modelica://PreloadedSprings.Operator.HeldMechanism\">held joystick</a> also that of the hand. It also
makes <code>alpha</code> that of the handle, or zero where
<a href=\"modelica://PreloadedSprings.Joystick.RubbingMechanism\">dry friction</a> holds it.</p>
<p>The <code>flange</code> is the shaft itself: what is connected to it, of this library or of
<code>Modelica.Mechanics.Rotational</code>, turns with the handle, loads it or drives it, beside the torque
<code>T</code>. Not connected, it has no effect.</p>
</html>"));
end DrivenMechanism;
