within PreloadedSprings.Units;
type TranslationalDamping = Real(
  final quantity = "TranslationalDampingConstant",
  final unit = "N.s/m",
  displayUnit = "N.s/m",
  min = 0) "Viscous damping of a translation"
  annotation (Documentation(info = "<html>
<p>Ratio of a damping force to a velocity, in N.s/m.</p>
</html>"));
