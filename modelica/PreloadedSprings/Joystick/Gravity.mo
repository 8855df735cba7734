within PreloadedSprings.Joystick;
model Gravity "Moment of the handle's weight about the pivot"
  parameter Units.Mass m(start = 0.87) "Mass of the handle";
  parameter Units.Length h(start = 0.082) "Distance from the pivot to the center of mass";
  parameter Units.Acceleration g(min = 0) = 9.80665 "Acceleration of gravity";
  Interfaces.RotationalFlange flange "Shaft of the handle"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Interfaces.Signals.TorqueOutput M_g "Moment of the weight, towards positive angles"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  Units.Energy E "Potential energy, zero in the upright position";
equation
  M_g = m*g*h*sin(flange.phi);
  flange.tau = -M_g;
  E = -2*m*g*h*sin(flange.phi/2)^2;
initial equation
  assert(m > 0, getInstanceName() + ".m must be positive, but is " + String(m) + " kg");
  assert(h >= 0, getInstanceName() + ".h must not be negative, but is " + String(h) + " m");
  assert(g >= 0, getInstanceName() + ".g must not be negative, but is " + String(g) + " m/s2");

  annotation (
    defaultComponentName = "gravity",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {-60, 0}, {-40, -50}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-40, -50}, {20, 40}}, color = {64, 64, 64}, thickness = 0.5),
      Ellipse(extent = {{-48, -42}, {-32, -58}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{0, 60}, {40, 20}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{20, 40}, {20, -50}}, color = {160, 60, 40}, thickness = 1,
        arrow = {Arrow.None, Arrow.Filled}, arrowSize = 12),
      Text(extent = {{26, -20}, {60, -60}}, textColor = {160, 60, 40}, textString = "mg"),
      Text(extent = {{40, 90}, {160, 50}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The right-hand side of eq. (1), <code>m*g*h*sin(theta)</code>: the center of mass lies above the pivot, so the
weight turns the handle away from the middle. The potential energy <code>m*g*h*(cos(theta) - 1)</code> is written
with the sine of half the angle, which is accurate near the middle.</p>
<p>With angles near 180 degrees, this is the inverted handle of the paper's swing test
(<a href=\"modelica://PreloadedSprings.Examples.SwingTest\">example</a>).</p>
</html>"));
end Gravity;
