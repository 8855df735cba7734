within PreloadedSprings.Joystick;
block BaseMotion "Moment on the handle of a base that accelerates, as in a vehicle"
  parameter Units.Mass m(start = 0.87) "Mass of the handle";
  parameter Units.Length h(start = 0.082) "Distance from the pivot to the center of mass";
  Interfaces.Signals.AngleInput theta "Angle of the handle to the base"
    annotation (Placement(transformation(extent = {{-120, 40}, {-100, 60}})));
  Interfaces.Signals.AccelerationInput a_base "Acceleration of the base, horizontal, towards positive angles"
    annotation (Placement(transformation(extent = {{-120, -60}, {-100, -40}})));
  Interfaces.Signals.TorqueOutput M_base "Moment about the pivot, towards positive angles"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
protected
  Units.Ratio t_half "Tangent of half the angle";
equation
  t_half = tan(theta/2);
  M_base = -m*h*(1 - t_half)*(1 + t_half)/(1 + t_half^2)*a_base "cos(theta) from the half angle, to save a cosine";

  annotation (
    defaultComponentName = "base",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-60, -40}, {40, -60}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-10, -40}, {-30, 50}}, color = {64, 64, 64}, thickness = 1),
      Ellipse(extent = {{-46, 66}, {-14, 34}}, lineColor = {64, 64, 64}, fillColor = {160, 60, 40},
        fillPattern = FillPattern.Solid),
      Line(points = {{44, -50}, {88, -50}}, color = {160, 60, 40}, thickness = 1,
        arrow = {Arrow.None, Arrow.Filled}, arrowSize = 12),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The joystick stands on a base that moves to and fro, such as the floor of a cabin: by <code>s</code> along the
horizontal line in the plane of the handle, towards positive angles. Its center of mass is then at
<code>s + h*sin(theta)</code>, <code>h*cos(theta)</code>, and its kinetic energy</p>
<blockquote><code>J*omega^2/2 + m*h*cos(theta)*omega*s' + m*s'^2/2</code>,</blockquote>
<p>where <code>J</code> is the moment of inertia about the pivot. Lagrange's equation for <code>theta</code>, the angle
to the base, gives eq. (1) with one more moment on its right-hand side:</p>
<blockquote><code>M_base = -m*h*cos(theta)*a_base</code>, <code>a_base = s''</code>.</blockquote>
<p>A base that accelerates forward leaves the handle behind. Turning and rising of the base are not included.</p>
</html>"));
end BaseMotion;
