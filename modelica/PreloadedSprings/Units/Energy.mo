within PreloadedSprings.Units;
type Energy = Real(
  final quantity = "Energy",
  final unit = "J",
  displayUnit = "mJ") "Energy"
  annotation (Documentation(info = "<html>
<p>Energies are in J and shown in mJ.</p>
</html>"));
