within PreloadedSprings.Joystick;
model CamPlate "Plate that turns with the handle and pushes one of two plungers (eqs. 2-5)"
  parameter Units.Length a(min = Constants.small, start = 0.02398) "Distance from the pivot to the plunger axes";
  parameter Units.Length b(start = 0.005) "Distance from the pivot to the cam surface";
  Interfaces.RotationalFlange flange "Shaft of the plate"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Interfaces.TranslationalFlange flange_forward "Contact with the plunger that is pushed at positive angles"
    annotation (Placement(transformation(extent = {{70, -110}, {90, -90}})));
  Interfaces.TranslationalFlange flange_backward "Contact with the plunger that is pushed at negative angles"
    annotation (Placement(transformation(extent = {{-90, -110}, {-70, -90}})));
  Interfaces.Signals.PositionOutput x "Travel of the contact, positive for either direction"
    annotation (Placement(transformation(extent = {{100, 70}, {120, 90}})));
  Interfaces.Signals.ForceOutput f_x "Contact force along the plunger axis"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  Interfaces.Signals.TorqueOutput M_s "Moment of the contact force about the pivot, against positive angles"
    annotation (Placement(transformation(extent = {{100, -90}, {120, -70}})));
  Interfaces.Signals.BooleanOutput isForward "True where the angle is positive"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
protected
  Units.Ratio t "Slope of the plate";
  Units.Ratio t_half "Tangent of half the angle";
equation
  t_half = tan(flange.phi/2);
  t = 2*t_half/((1 - t_half)*(1 + t_half)) "= tan(flange.phi), from the half angle to save a tangent";
  flange_forward.s = t*(a - b*t_half);
  flange_backward.s = -t*(a + b*t_half);
  M_s = -flange_forward.f*(a + (flange_forward.s - b)*t) - flange_backward.f*((flange_backward.s - b)*t - a);
  flange.tau = M_s;
  isForward = flange.phi > 0;
  x = if isForward then flange_forward.s else flange_backward.s;
  f_x = -(flange_forward.f + flange_backward.f);
initial equation
  assert(a > 0, getInstanceName() + ".a must be positive, but is " + String(a) + " m");
  assert(b >= 0, getInstanceName() + ".b must not be negative, but is " + String(b) + " m");

  annotation (
    defaultComponentName = "camPlate",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {0, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Polygon(points = {{-86, 8}, {80, -52}, {88, -30}, {18, -4}, {14, 20}, {-14, 30}, {-24, 12}, {-78, 30}, {-86, 8}},
        lineColor = {64, 64, 64}, fillColor = {192, 192, 192}, fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-12, 16}, {8, -4}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{80, -90}, {80, -58}}, color = {0, 127, 0}, thickness = 0.5),
      Ellipse(extent = {{72, -50}, {88, -66}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Line(points = {{-80, -90}, {-80, -40}}, color = {0, 127, 0}, thickness = 0.5),
      Ellipse(extent = {{-88, -26}, {-72, -42}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-66, -60}, {66, -90}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The plate turns about the pivot. Its lower surface lies the distance <code>b</code> below the pivot and
touches the hemispherical heads of two plungers, whose axes run at the distance <code>a</code> on either side
(Figs. 2 and 6). Eliminating the radius of the contact point from eqs. (2a, b) gives its travel, eq. (3):</p>
<blockquote><code>x = a*|tan(theta)| + b*(1 - 1/cos(theta))</code>.</blockquote>
<p>The plate keeps both contacts. Each follows eq. (3) without the magnitude signs, with <code>a</code>
towards positive angles for the forward plunger and towards negative angles for the backward one:</p>
<blockquote><code>flange_forward.s = a*tan(theta) + b*(1 - 1/cos(theta)) = tan(theta)*(a - b*tan(theta/2))</code>,<br>
<code>flange_backward.s = -a*tan(theta) + b*(1 - 1/cos(theta)) = -tan(theta)*(a + b*tan(theta/2))</code>.</blockquote>
<p>On the side that the plate turns away from, the travel is negative and the plunger, which engages after a
clearance that is not negative, exerts no force. So both travels are smooth and none needs to know the sign of
the angle. The right-hand forms avoid the small difference <code>1 - 1/cos(theta)</code>.</p>
<p>The moment of the contact force with the arm <code>d = x - b</code> of its horizontal component, eq. (4), is</p>
<blockquote><code>M_s = (a*sign(theta) + d*tan(theta))*f_x</code>.</blockquote>
<p>Eq. (5) is printed as <code>a*(sign(theta) + d*tan(theta))*f_x</code>, which adds a length to a number. The form
above equals <code>f_x*dx/dtheta</code>, so the contact neither makes nor takes energy.</p>
<p>The output <code>isForward</code> is where the library tests the sign of the angle; its change is one state
event. The angle must stay between -90 and 90 degrees, which the joystick sees to.</p>
</html>"));
end CamPlate;
