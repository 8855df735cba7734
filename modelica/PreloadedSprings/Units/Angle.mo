within PreloadedSprings.Units;
type Angle = Real(
  final quantity = "Angle",
  final unit = "rad",
  displayUnit = "deg") "Angle"
  annotation (Documentation(info = "<html>
<p>Angles are in rad and shown in degrees.</p>
</html>"));
