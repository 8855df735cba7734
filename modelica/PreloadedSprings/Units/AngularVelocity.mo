within PreloadedSprings.Units;
type AngularVelocity = Real(
  final quantity = "AngularVelocity",
  final unit = "rad/s",
  displayUnit = "deg/s") "Angular velocity"
  annotation (Documentation(info = "<html>
<p>Angular velocities are in rad/s and shown in degrees per second.</p>
</html>"));
