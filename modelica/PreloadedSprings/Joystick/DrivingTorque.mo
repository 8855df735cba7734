within PreloadedSprings.Joystick;
model DrivingTorque "Torque that is applied to a shaft from outside"
  Interfaces.Signals.TorqueInput T "Torque towards positive angles"
    annotation (Placement(transformation(extent = {{-120, -10}, {-100, 10}})));
  Interfaces.RotationalFlange flange "Driven shaft"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
equation
  flange.tau = -T;

  annotation (
    defaultComponentName = "drive",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{40, 0}, {90, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-60, -40}, {-56, 0}, {-34, 34}, {0, 48}, {34, 34}, {50, 10}}, color = {160, 60, 40},
        thickness = 1, arrow = {Arrow.None, Arrow.Filled}, arrowSize = 12),
      Rectangle(extent = {{-10, 10}, {40, -10}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-150, -60}, {150, -100}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The torque <code>T</code> that eq. (13) adds to the right-hand side of eq. (1), such as an operator's.</p>
</html>"));
end DrivingTorque;
