within PreloadedSprings.Units;
type Mass = Real(
  final quantity = "Mass",
  final unit = "kg",
  displayUnit = "kg",
  min = 0) "Mass"
  annotation (Documentation(info = "<html>
<p>Masses are in kg.</p>
</html>"));
