within PreloadedSprings.Interfaces.Signals;
connector AccelerationInput = input Units.Acceleration "Acceleration as a signal going in"
  annotation (
    defaultComponentName = "a",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-100, 100}, {100, 0}, {-100, -100}, {-100, 100}}, lineColor = {0, 0, 127},
        fillColor = {0, 0, 127}, fillPattern = FillPattern.Solid)}),
    Diagram(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{0, 50}, {100, 0}, {0, -50}, {0, 50}}, lineColor = {0, 0, 127},
        fillColor = {0, 0, 127}, fillPattern = FillPattern.Solid),
      Text(extent = {{-10, 85}, {-10, 60}}, textColor = {0, 0, 127}, textString = "%name")}),
    Documentation(info = "<html>
<p>A signal of type <a href=\"modelica://PreloadedSprings.Units.Acceleration\">Units.Acceleration</a>.</p>
</html>"));
