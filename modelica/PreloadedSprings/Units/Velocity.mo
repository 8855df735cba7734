within PreloadedSprings.Units;
type Velocity = Real(
  final quantity = "Velocity",
  final unit = "m/s",
  displayUnit = "mm/s") "Velocity"
  annotation (Documentation(info = "<html>
<p>Velocities are in m/s and shown in mm/s.</p>
</html>"));
