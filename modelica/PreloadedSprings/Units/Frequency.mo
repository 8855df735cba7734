within PreloadedSprings.Units;
type Frequency = Real(
  final quantity = "Frequency",
  final unit = "Hz",
  displayUnit = "Hz",
  min = 0) "Frequency"
  annotation (Documentation(info = "<html>
<p>Frequencies are in Hz, that is in cycles per second.</p>
</html>"));
