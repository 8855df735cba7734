within PreloadedSprings.Interfaces;
connector RotationalFlange "Shaft that turns about a fixed axis"
  Units.Angle phi "Angle of the flange";
  flow Units.Torque tau "Torque that acts on the component through the flange";

  annotation (
    defaultComponentName = "flange",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Ellipse(extent = {{-100, 100}, {100, -100}}, lineColor = {64, 64, 64}, fillColor = {128, 128, 128},
        fillPattern = FillPattern.Solid)}),
    Diagram(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Ellipse(extent = {{-40, 40}, {40, -40}}, lineColor = {64, 64, 64}, fillColor = {128, 128, 128},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-150, 110}, {150, 60}}, textColor = {64, 64, 64}, textString = "%name")}),
    Documentation(info = "<html>
<p>Connected flanges share the angle <code>phi</code>, and their torques add up to zero. The same pair as
in <code>Modelica.Mechanics.Rotational.Interfaces</code>, to which it connects.</p>
</html>"));
end RotationalFlange;
