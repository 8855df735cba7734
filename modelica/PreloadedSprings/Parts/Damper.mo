within PreloadedSprings.Parts;
model Damper "Linear viscous damper between two flanges"
  extends Interfaces.ForceElement;
  parameter Units.TranslationalDamping d(start = 1) "Damping coefficient";
  Units.Velocity v "Velocity of flange_a towards flange_b";
equation
  v = der(x);
  f = d*v;
  E = 0;
initial equation
  assert(d >= 0, getInstanceName() + ".d must not be negative, but is " + String(d) + " N.s/m");

  annotation (
    defaultComponentName = "damper",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {-10, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{60, 0}, {90, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Rectangle(extent = {{-40, 30}, {60, -30}}, pattern = LinePattern.None, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-60, 30}, {60, 30}, {60, -30}, {-60, -30}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-10, 24}, {-10, -24}}, color = {0, 127, 0}, thickness = 1),
      Line(points = {{-40, 0}, {-10, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Text(extent = {{-150, -50}, {150, -80}}, textColor = {0, 0, 0}, textString = "d = %d")}),
    Documentation(info = "<html>
<p>The force is <code>d</code> times the velocity of compression. Unlike a spring of this library, it also
pulls. Nothing is stored: <code>E</code> is zero.</p>
</html>"));
end Damper;
