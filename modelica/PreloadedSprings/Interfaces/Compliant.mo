within PreloadedSprings.Interfaces;
partial model Compliant "Anything that resists being compressed between two flanges"
  PreloadedSprings.Interfaces.TranslationalFlange flange_a "Flange that is pushed towards flange_b"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  PreloadedSprings.Interfaces.TranslationalFlange flange_b "Flange that the component rests on"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
  PreloadedSprings.Units.Position x "Travel of flange_a towards flange_b";
  PreloadedSprings.Units.Force f "Force that pushes flange_a towards flange_b";
  PreloadedSprings.Units.Energy E "Energy that is stored in the component";
equation
  x = flange_a.s - flange_b.s;
  f = flange_a.f;

  annotation (Documentation(info = "<html>
<p>The travel <code>x</code> is zero where both flanges have the same position. An extending class gives
the relation between the travel and the forces, and the energy <code>E</code>, which is the integral of
<code>f</code> over <code>x</code>.</p>
</html>"));
end Compliant;
