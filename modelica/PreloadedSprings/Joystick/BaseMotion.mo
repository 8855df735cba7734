within PreloadedSprings.Joystick;
block BaseMotion "Moment on the handle of a base that moves, as in a vehicle"
  parameter Units.Mass m(start = 0.87) "Mass of the handle";
  parameter Units.Length h(start = 0.082) "Distance from the pivot to the center of mass";
  parameter Units.MomentOfInertia J(start = 0.01135) "Moment of inertia of the handle about the pivot";
  Interfaces.Signals.AngleInput theta "Angle of the handle to the base"
    annotation (Placement(transformation(extent = {{-120, 60}, {-100, 80}})));
  Interfaces.Signals.AccelerationInput a_base "Acceleration of the pivot along the base, towards positive angles"
    annotation (Placement(transformation(extent = {{-120, 10}, {-100, 30}})));
  Interfaces.Signals.AccelerationInput a_base_z "Acceleration of the pivot away from the base, upwards"
    annotation (Placement(transformation(extent = {{-120, -40}, {-100, -20}})));
  Interfaces.Signals.AngularAccelerationInput alpha_base
    "Angular acceleration of the base, towards positive angles"
    annotation (Placement(transformation(extent = {{-120, -90}, {-100, -70}})));
  Interfaces.Signals.TorqueOutput M_base "Moment about the pivot, towards positive angles"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
protected
  Units.Ratio t_half "Tangent of half the angle";
equation
  t_half = tan(theta/2);
  M_base = -m*h*(1 - t_half)*(1 + t_half)/(1 + t_half^2)*a_base + m*h*2*t_half/(1 + t_half^2)*a_base_z
    - J*alpha_base "Cosine and sine from the half angle, to save both";

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
<p>The joystick stands on a base that moves in the plane of the handle, such as the floor of a cabin: its pivot moves
by <code>s</code> forward, that is towards positive angles, and by <code>z</code> upward, and the base turns by
<code>phi</code>. In space the handle is then at the angle <code>psi = theta + phi</code>, its center of mass at
<code>s + h*sin(psi)</code>, <code>z + h*cos(psi)</code>, and Lagrange's equation is</p>
<blockquote><code>J*psi'' = m*h*((g + z'')*sin(psi) - s''*cos(psi))</code> + moments between handle and base,
</blockquote>
<p>where <code>J</code> is the moment of inertia about the pivot. For <code>theta</code>, the angle to the base, that
is eq. (1) with one more moment on its right-hand side:</p>
<blockquote><code>M_base = m*h*(a_base_z*sin(theta) - a_base*cos(theta)) - J*alpha_base</code>,
<code>alpha_base = phi''</code>,<br>
<code>a_base = s''*cos(phi) - (g + z'')*sin(phi)</code>,
<code>a_base_z = s''*sin(phi) + (g + z'')*cos(phi) - g</code>.</blockquote>
<p>The accelerations are what an accelerometer on the base shows at the pivot, less <code>g</code> upward: on a base
that does not turn those of the base, on one that is tilted with the weight's part along it. A base that accelerates
forward leaves the handle behind; one that rises makes it heavier.</p>
</html>"));
end BaseMotion;
