within PreloadedSprings.Interfaces;
package Signals "Inputs and outputs that carry one number or truth value"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-60, 50}, {60, 0}, {-60, -50}, {-60, 50}}, lineColor = {0, 0, 127},
        fillColor = {0, 0, 127}, fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>One connector for each quantity and direction, so that units reveal a connection of an angle to a torque. The types
and units are those of <a href=\"modelica://PreloadedSprings.Units\">Units</a>. They connect to the
<code>RealInput</code>, <code>RealOutput</code>, <code>BooleanInput</code> and <code>BooleanOutput</code> of the
Modelica Standard Library.</p>
</html>"));
end Signals;
