within PreloadedSprings.Units;
type Ratio = Real(
  final unit = "1") "Number without a unit"
  annotation (Documentation(info = "<html>
<p>Exponents, weights and factors.</p>
</html>"));
