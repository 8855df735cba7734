within PreloadedSprings.Units;
type Acceleration = Real(
  final quantity = "Acceleration",
  final unit = "m/s2",
  displayUnit = "m/s2") "Acceleration"
  annotation (Documentation(info = "<html>
<p>Accelerations are in m/s2.</p>
</html>"));
