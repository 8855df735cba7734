within PreloadedSprings.Interfaces;
partial model Compliant "Component that resists being compressed between two flanges"
  TranslationalFlange flange_a "Flange that is pushed towards flange_b"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  TranslationalFlange flange_b "Flange that the component rests on"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
  Units.Position x "Travel of flange_a towards flange_b";
  Units.Force f "Force that pushes flange_a towards flange_b";
  Units.Energy E "Energy that is stored in the component";
equation
  x = flange_a.s - flange_b.s;
  f = flange_a.f;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{-150, 100}, {150, 60}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The travel <code>x</code> is zero where both flanges have the same position. An extending class gives
the relation between the travel and the forces at its flanges, and the stored energy <code>E</code>,
which for a spring is the integral of <code>f</code> over <code>x</code>.</p>
</html>"));
end Compliant;
