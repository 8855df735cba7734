within PreloadedSprings.Units;
type Length = Real(
  final quantity = "Length",
  final unit = "m",
  displayUnit = "mm",
  min = 0) "Length that cannot be negative"
  annotation (Documentation(info = "<html>
<p>Lengths are in m and shown in mm, the unit of the paper's Table 1.</p>
</html>"));
