within PreloadedSprings.Operator;
model MountedJoystick "Joystick on a base that moves, with stops, a hand, and constant damping"
  extends MountedMechanism;
  replaceable Damping.Constant damping
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
<p>A joystick where it is used: on a <a href=\"modelica://PreloadedSprings.Joystick.BaseMotion\">base</a> that
goes, rises and turns, as in a vehicle, between mechanical
<a href=\"modelica://PreloadedSprings.Joystick.Stops\">stops</a>, in the
<a href=\"modelica://PreloadedSprings.Operator.HandArm\">hand</a> of an operator. It is
<a href=\"modelica://PreloadedSprings.Operator.HeldJoystick\">HeldJoystick</a> with two more moments:</p>
<blockquote><code>J*alpha + C*omega + M_f + M_s + M_stop = m*g*h*sin(theta) + T + T_hand + M_base</code>.</blockquote>
<p>By preset there are no stops, no dry friction, no hand, and the base is at rest: that is
<a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a>. All angles are relative to the base, that of the
hand too: the operator sits on it. <code>E</code> is the energy of the joystick alone; without a torque and a hand, on
a base at rest, <code>E + stops.E</code> never rises.</p>
<p>State events are those of <a href=\"modelica://PreloadedSprings.Joystick.JoystickFriction\">JoystickFriction</a> and
where the handle meets and leaves a stop.</p>
</html>"));
end MountedJoystick;
