within PreloadedSprings.Units;
type Torque = Real(
  final quantity = "Torque",
  final unit = "N.m",
  displayUnit = "N.m") "Torque or moment"
  annotation (Documentation(info = "<html>
<p>Torques and moments are in N.m.</p>
</html>"));
