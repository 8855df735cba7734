within PreloadedSprings.Operator;
model HeldJoystick "Joystick that a hand holds and lets go, with constant damping"
  extends HeldMechanism;
  replaceable Damping.Constant damping
    constrainedby Interfaces.DampingLaw "Damping law"
    annotation (choicesAllMatching = true, Placement(transformation(extent = {{-30, -10}, {30, 50}})));
equation
  damping.omega = omega;
  drive.T = T + T_hand;
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
<p><a href=\"modelica://PreloadedSprings.Joystick.JoystickFriction\">JoystickFriction</a> in the hand of an
operator: the hand draws the handle to <code>theta_ref</code>, which moves with <code>omega_ref</code>, while
<code>grip</code> is 1. With <code>grip = 0</code>, the preset, the motion is that of
JoystickFriction, to the last bit.</p>
<p>The model is made for a person who moves the wanted angle while the simulation runs: one communication step for
each picture, in which <code>theta_ref</code> goes straight from one pointed angle to the next.</p>
</html>"));
end HeldJoystick;
