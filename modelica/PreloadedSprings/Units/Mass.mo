within PreloadedSprings.Units;
type Mass = Real(
  final quantity = "Mass",
  final unit = "kg",
  displayUnit = "kg",
  min = Constants.small) "Mass"
  annotation (Documentation(info = "<html>
<p>Masses are in kg. They are positive.</p>
</html>"));
