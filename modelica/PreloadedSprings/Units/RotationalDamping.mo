within PreloadedSprings.Units;
type RotationalDamping = Real(
  final quantity = "RotationalDampingConstant",
  final unit = "N.m.s/rad",
  displayUnit = "N.m.s/rad",
  min = 0) "Viscous damping of a rotation"
  annotation (Documentation(info = "<html>
<p>Ratio of a damping moment to an angular velocity, in N.m.s/rad.</p>
</html>"));
