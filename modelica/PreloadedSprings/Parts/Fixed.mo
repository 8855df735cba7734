within PreloadedSprings.Parts;
model Fixed "Flange that does not move"
  Interfaces.TranslationalFlange flange "Fixed flange"
    annotation (Placement(transformation(extent = {{-10, -10}, {10, 10}})));
equation
  flange.s = 0;

  annotation (
    defaultComponentName = "wall",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{0, 0}, {0, -40}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-80, -40}, {80, -40}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{80, -40}, {40, -80}}, color = {64, 64, 64}),
      Line(points = {{40, -40}, {0, -80}}, color = {64, 64, 64}),
      Line(points = {{0, -40}, {-40, -80}}, color = {64, 64, 64}),
      Line(points = {{-40, -40}, {-80, -80}}, color = {64, 64, 64}),
      Text(extent = {{-150, -90}, {150, -130}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>Holds its flange at the position zero, whatever the force.</p>
</html>"));
end Fixed;
