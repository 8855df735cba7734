within PreloadedSprings.Parts;
model Press "Flange that is moved at a constant speed"
  parameter Units.Velocity v(start = 1e-3) "Speed";
  Interfaces.TranslationalFlange flange "Moved flange"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
  Units.Position s "Position, zero at the time zero";
  Units.Force f "Force that the press exerts";
equation
  s = v*time;
  flange.s = s;
  f = -flange.f;

  annotation (
    defaultComponentName = "press",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-80, 60}, {20, -60}}, lineColor = {64, 64, 64}, fillColor = {235, 235, 235},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{20, 16}, {90, -16}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Polygon(points = {{-60, 10}, {-20, 10}, {-20, 28}, {6, 0}, {-20, -28}, {-20, -10}, {-60, -10}, {-60, 10}},
        lineColor = {0, 127, 0}, fillColor = {0, 127, 0}, fillPattern = FillPattern.Solid),
      Text(extent = {{-150, 110}, {150, 70}}, textColor = {0, 0, 255}, textString = "%name"),
      Text(extent = {{-150, -70}, {150, -100}}, textColor = {0, 0, 0}, textString = "v = %v")}),
    Documentation(info = "<html>
<p>The crosshead of a testing machine, for load-deflection curves such as that of Fig. 7.</p>
</html>"));
end Press;
