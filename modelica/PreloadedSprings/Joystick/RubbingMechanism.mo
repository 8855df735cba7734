within PreloadedSprings.Joystick;
partial model RubbingMechanism "Mechanism that a torque drives against dry friction: a joystick without its damping law"
  extends DrivenMechanism;
  Friction.StickSlip friction(final a = a, final b = b) "Dry friction of the pivot and of the plungers"
    annotation (Placement(transformation(extent = {{100, -200}, {140, -160}})));
  Interfaces.Signals.TorqueOutput M_f "Dry friction moment, against the motion"
    annotation (Placement(transformation(extent = {{200, -180}, {220, -160}}),
      iconTransformation(origin = {-40, -108}, extent = {{-8, -8}, {8, 8}}, rotation = -90)));
  Interfaces.Signals.BooleanOutput isStuck "True while the joystick sticks"
    annotation (Placement(transformation(extent = {{200, -200}, {220, -180}}),
      iconTransformation(origin = {40, -108}, extent = {{-8, -8}, {8, 8}}, rotation = -90)));
equation
  friction.omega = omega;
  friction.isForwardInContact = forward.returnSpring.isEngaged;
  friction.isBackwardInContact = backward.returnSpring.isEngaged;
  friction.M = drive.T + flange.tau + M_g - M_s - M_d;
  alpha = if isStuck then 0 else handle.alpha;
  when change(friction.mode) then
    reinit(omega, 0);
  end when;
  connect(friction.flange, handle.flange)
    annotation (Line(points = {{100, -180}, {70, -180}, {70, -214}, {-58, -214}, {-58, -122}, {-80, -122}, {-80, 110},
      {-30, 110}}, color = {64, 64, 64}));
  connect(friction.M_f, M_f)
    annotation (Line(points = {{142, -170}, {210, -170}}, color = {0, 0, 127}));
  connect(friction.isStuck, isStuck)
    annotation (Line(points = {{142, -190}, {210, -190}}, color = {255, 0, 255}));

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{-60, -84}, {-20, -100}}, textColor = {0, 0, 127}, textString = "M_f"),
      Text(extent = {{20, -84}, {60, -100}}, textColor = {255, 0, 255}, textString = "isStuck")}),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Joystick.JoystickFriction\">JoystickFriction</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickFrictionPowerLaw\">JoystickFrictionPowerLaw</a> have in common:
the <a href=\"modelica://PreloadedSprings.Joystick.DrivenMechanism\">DrivenMechanism</a>, held or slowed by
<a href=\"modelica://PreloadedSprings.Friction.StickSlip\">dry friction</a>. The friction needs to know the moment of
everything else on the shaft, <code>drive.T + flange.tau + M_g - M_s - M_d</code>. Where the motion turns, or begins or
ends to stick, <code>omega</code> is set to zero; while it sticks, <code>alpha</code> is zero.</p>
</html>"));
end RubbingMechanism;
