within PreloadedSprings.Interfaces.Signals;
connector TorqueOutput = output Units.Torque "Torque as a signal going out"
  annotation (
    defaultComponentName = "T",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-100, 100}, {100, 0}, {-100, -100}, {-100, 100}}, lineColor = {0, 0, 127},
        fillColor = {255, 255, 255}, fillPattern = FillPattern.Solid)}),
    Diagram(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-100, 50}, {0, 0}, {-100, -50}, {-100, 50}}, lineColor = {0, 0, 127},
        fillColor = {255, 255, 255}, fillPattern = FillPattern.Solid),
      Text(extent = {{30, 110}, {30, 60}}, textColor = {0, 0, 127}, textString = "%name")}),
    Documentation(info = "<html>
<p>A signal of type <a href=\"modelica://PreloadedSprings.Units.Torque\">Units.Torque</a>.</p>
</html>"));
