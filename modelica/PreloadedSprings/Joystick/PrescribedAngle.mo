within PreloadedSprings.Joystick;
model PrescribedAngle "Angle that is imposed on a shaft from outside"
  Interfaces.Signals.AngleInput theta "Angle of the shaft"
    annotation (Placement(transformation(extent = {{-120, -10}, {-100, 10}})));
  Interfaces.RotationalFlange flange "Driven shaft"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
  Interfaces.Signals.TorqueOutput T "Torque that the motion needs, towards positive angles"
    annotation (Placement(transformation(origin = {0, -110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
equation
  flange.phi = theta;
  T = -flange.tau;

  annotation (
    defaultComponentName = "motion",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{40, 0}, {90, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-70, 20}, {-56, 20}, {-40, 30}, {-20, 60}, {0, 70}, {20, 60}, {40, 30}, {56, 20}, {70, 20}},
        color = {40, 90, 140}, thickness = 0.5, smooth = Smooth.Bezier),
      Rectangle(extent = {{-40, 14}, {40, -14}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-150, -40}, {150, -80}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>Makes the shaft follow the angle <code>theta</code> and reports the torque <code>T</code> that this takes,
eq. (13).</p>
</html>"));
end PrescribedAngle;
