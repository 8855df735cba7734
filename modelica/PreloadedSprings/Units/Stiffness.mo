within PreloadedSprings.Units;
type Stiffness = Real(
  final quantity = "TranslationalSpringConstant",
  final unit = "N/m",
  displayUnit = "N/mm",
  min = Constants.small) "Stiffness of a spring or of a restraint"
  annotation (Documentation(info = "<html>
<p>Stiffnesses are in N/m and shown in N/mm. They are positive.</p>
</html>"));
