within PreloadedSprings.Joystick;
model Handle "Inertia of the handle about the pivot"
  parameter Units.MomentOfInertia J(start = 0.01135) "Mass moment of inertia about the pivot";
  Interfaces.RotationalFlange flange "Shaft of the handle"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Interfaces.Signals.AngularVelocityInput omega "Angular velocity"
    annotation (Placement(transformation(origin = {0, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Interfaces.Signals.AngularAccelerationInput alpha "Angular acceleration"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  Units.Energy E "Kinetic energy";
equation
  flange.tau = J*alpha;
  E = J*omega^2/2;
initial equation
  assert(J > 0, getInstanceName() + ".J must be positive, but is " + String(J) + " kg.m2");

  annotation (
    defaultComponentName = "handle",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {-50, 0}, {-20, -56}}, color = {64, 64, 64}, thickness = 0.5),
      Polygon(points = {{-28, -56}, {0, 20}, {14, 14}, {-12, -62}, {-28, -56}}, lineColor = {64, 64, 64},
        fillColor = {192, 192, 192}, fillPattern = FillPattern.Solid),
      Polygon(points = {{-8, 20}, {16, 78}, {34, 82}, {44, 66}, {22, 8}, {-8, 20}}, lineColor = {64, 64, 64},
        fillColor = {160, 60, 40}, fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-32, -46}, {-8, -70}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Text(extent = {{24, -20}, {104, -50}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The first term of eq. (1): the torque <code>J*alpha</code> that accelerates the handle.</p>
<p>The derivatives of the angle are inputs, not taken here. Where the motion is computed, the joystick
integrates them; where it is prescribed, they come from outside and nothing is differentiated.</p>
</html>"));
end Handle;
