within PreloadedSprings.Units;
type Time = Real(
  final quantity = "Time",
  final unit = "s",
  displayUnit = "s") "Time"
  annotation (Documentation(info = "<html>
<p>Times are in s.</p>
</html>"));
