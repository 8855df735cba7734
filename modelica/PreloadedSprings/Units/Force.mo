within PreloadedSprings.Units;
type Force = Real(
  final quantity = "Force",
  final unit = "N",
  displayUnit = "N") "Force"
  annotation (Documentation(info = "<html>
<p>Forces are in N.</p>
</html>"));
