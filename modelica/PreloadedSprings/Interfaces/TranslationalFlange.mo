within PreloadedSprings.Interfaces;
connector TranslationalFlange "Point of a body that moves along a line"
  Units.Position s "Position of the flange";
  flow Units.Force f "Force that acts on the component through the flange";

  annotation (
    defaultComponentName = "flange",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid)}),
    Diagram(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-40, 40}, {40, -40}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-150, 110}, {150, 60}}, textColor = {0, 127, 0}, textString = "%name")}),
    Documentation(info = "<html>
<p>Connected flanges share the position <code>s</code>, and their forces add up to zero. The same pair as
in <code>Modelica.Mechanics.Translational.Interfaces</code>, to which it connects.</p>
</html>"));
end TranslationalFlange;
