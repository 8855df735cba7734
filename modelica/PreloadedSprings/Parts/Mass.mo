within PreloadedSprings.Parts;
model Mass "Rigid mass that slides along a line"
  parameter Units.Mass m(start = 1) "Mass";
  Interfaces.TranslationalFlange flange_a "Left side of the mass"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Interfaces.TranslationalFlange flange_b "Right side of the mass"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
  Units.Position s(nominal = 1e-3, stateSelect = StateSelect.prefer) "Position";
  Units.Velocity v(nominal = 0.1, stateSelect = StateSelect.prefer) "Velocity";
  Units.Acceleration acceleration "Acceleration";
  Units.Energy E "Kinetic energy";
equation
  flange_a.s = s;
  flange_b.s = s;
  v = der(s);
  acceleration = der(v);
  m*acceleration = flange_a.f + flange_b.f;
  E = m*v^2/2;
initial equation
  assert(m > 0, getInstanceName() + ".m must be positive, but is " + String(m) + " kg");

  annotation (
    defaultComponentName = "mass",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {90, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Rectangle(extent = {{-60, 40}, {60, -40}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Text(extent = {{-150, 90}, {150, 50}}, textColor = {0, 0, 255}, textString = "%name"),
      Text(extent = {{-150, -50}, {150, -80}}, textColor = {0, 0, 0}, textString = "m = %m")}),
    Documentation(info = "<html>
<p>Newton's law for the forces at both sides. The length of the mass is left out: both flanges have the
position <code>s</code>.</p>
</html>"));
end Mass;
