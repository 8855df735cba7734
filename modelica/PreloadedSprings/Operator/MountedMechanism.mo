within PreloadedSprings.Operator;
partial model MountedMechanism "Mechanism with stops, in a hand, on a base that moves: without its damping law"
  extends HeldMechanism;
  Interfaces.Signals.AccelerationInput a_base(start = 0)
    "Acceleration of the base along itself in the plane of the handle, towards positive angles"
    annotation (Placement(transformation(extent = {{-220, 176}, {-200, 196}}),
      iconTransformation(extent = {{-120, 15}, {-100, 35}})));
  Interfaces.Signals.AccelerationInput a_base_z(start = 0) "Acceleration of the base upwards, without that of gravity"
    annotation (Placement(transformation(extent = {{-220, 152}, {-200, 172}}),
      iconTransformation(extent = {{-120, -38}, {-100, -18}})));
  Interfaces.Signals.AngularAccelerationInput alpha_base(start = 0)
    "Angular acceleration of the base, towards positive angles"
    annotation (Placement(transformation(extent = {{-220, 128}, {-200, 148}}),
      iconTransformation(origin = {-35, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Interfaces.Signals.TorqueOutput M_base "Moment of the base's acceleration, towards positive angles"
    annotation (Placement(transformation(extent = {{200, 190}, {220, 210}}),
      iconTransformation(origin = {-70, -108}, extent = {{-8, -8}, {8, 8}}, rotation = -90)));
  Interfaces.Signals.TorqueOutput M_stop "Moment of the stops, against positive angles"
    annotation (Placement(transformation(extent = {{-60, -220}, {-40, -200}}),
      iconTransformation(origin = {70, -108}, extent = {{-8, -8}, {8, 8}}, rotation = -90)));
  Joystick.BaseMotion base(final m = m, final h = h, final J = J) "Base on which the joystick stands"
    annotation (Placement(transformation(extent = {{-180, 130}, {-140, 170}})));
  Joystick.Stops stops "Mechanical stops, none by preset"
    annotation (Placement(transformation(extent = {{-120, -210}, {-80, -170}})));
equation
  base.theta = theta;
  stops.theta = theta;
  stops.omega = omega;
  stops.isForward = camPlate.isForward;
  drive.T = T + T_hand + M_base - M_stop;
  connect(a_base, base.a_base)
    annotation (Line(points = {{-210, 186}, {-190, 186}, {-190, 154}, {-182, 154}}, color = {0, 0, 127}));
  connect(a_base_z, base.a_base_z)
    annotation (Line(points = {{-210, 162}, {-194, 162}, {-194, 144}, {-182, 144}}, color = {0, 0, 127}));
  connect(alpha_base, base.alpha_base)
    annotation (Line(points = {{-210, 138}, {-198, 138}, {-198, 134}, {-182, 134}}, color = {0, 0, 127}));
  connect(base.M_base, M_base)
    annotation (Line(points = {{-138, 150}, {-120, 150}, {-120, 200}, {210, 200}}, color = {0, 0, 127}));
  connect(stops.M_stop, M_stop)
    annotation (Line(points = {{-78, -190}, {-50, -190}, {-50, -210}}, color = {0, 0, 127}));

  annotation (Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Operator.MountedJoystick\">MountedJoystick</a> and
<a href=\"modelica://PreloadedSprings.Operator.MountedJoystickPowerLaw\">MountedJoystickPowerLaw</a> have in common: the
<a href=\"modelica://PreloadedSprings.Operator.HeldMechanism\">HeldMechanism</a>, on which the acceleration of the
<a href=\"modelica://PreloadedSprings.Joystick.BaseMotion\">base</a> and the
<a href=\"modelica://PreloadedSprings.Joystick.Stops\">stops</a> act as well.</p>
</html>"));
end MountedMechanism;
