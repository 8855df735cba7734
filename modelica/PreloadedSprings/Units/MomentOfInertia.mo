within PreloadedSprings.Units;
type MomentOfInertia = Real(
  final quantity = "MomentOfInertia",
  final unit = "kg.m2",
  displayUnit = "kg.m2",
  min = Constants.small) "Mass moment of inertia"
  annotation (Documentation(info = "<html>
<p>Mass moments of inertia are in kg.m2. They are positive.</p>
</html>"));
