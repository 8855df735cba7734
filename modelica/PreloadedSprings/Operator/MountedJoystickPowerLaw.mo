within PreloadedSprings.Operator;
model MountedJoystickPowerLaw "Joystick on a base that moves, with stops, a hand, and damping by power laws (eq. 11)"
  extends MountedMechanism;
  replaceable Damping.PowerLaw damping
    constrainedby Interfaces.DampingLaw "Damping law"
    annotation (choicesAllMatching = true, Placement(transformation(extent = {{-30, -10}, {30, 50}})));
equation
  damping.omega = omega;
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
<p>The same as <a href=\"modelica://PreloadedSprings.Operator.MountedJoystick\">MountedJoystick</a>, with the damping
coefficient of eq. (11), <a href=\"modelica://PreloadedSprings.Damping.PowerLaw\">Damping.PowerLaw</a>.</p>
</html>"));
end MountedJoystickPowerLaw;
