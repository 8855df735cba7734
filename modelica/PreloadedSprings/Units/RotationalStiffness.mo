within PreloadedSprings.Units;
type RotationalStiffness = Real(
  final quantity = "RotationalSpringConstant",
  final unit = "N.m/rad",
  displayUnit = "N.m/rad",
  min = 0) "Stiffness of a rotation"
  annotation (Documentation(info = "<html>
<p>Ratio of a moment to an angle, in N.m/rad.</p>
</html>"));
