within PreloadedSprings;
package Parts "What the springs act on: masses, walls, dampers and a press"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-40, 40}, {40, -30}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Line(points = {{-70, -30}, {70, -30}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-60, -30}, {-72, -46}}, color = {64, 64, 64}),
      Line(points = {{-20, -30}, {-32, -46}}, color = {64, 64, 64}),
      Line(points = {{20, -30}, {8, -46}}, color = {64, 64, 64}),
      Line(points = {{60, -30}, {48, -46}}, color = {64, 64, 64})}),
    Documentation(info = "<html>
<p>Simple translational components, enough for the examples and for chains of masses and preloaded
springs. Those of <code>Modelica.Mechanics.Translational</code> connect as well.</p>
</html>"));
end Parts;
