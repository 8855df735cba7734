within PreloadedSprings.Units;
type AngularAcceleration = Real(
  final quantity = "AngularAcceleration",
  final unit = "rad/s2",
  displayUnit = "deg/s2") "Angular acceleration"
  annotation (Documentation(info = "<html>
<p>Angular accelerations are in rad/s2 and shown in degrees per second squared.</p>
</html>"));
