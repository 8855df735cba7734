within PreloadedSprings.Units;
type Position = Real(
  final quantity = "Length",
  final unit = "m",
  displayUnit = "mm") "Position or travel of either sign"
  annotation (Documentation(info = "<html>
<p>Positions are in m and shown in mm. The same quantity
as <a href=\"modelica://PreloadedSprings.Units.Length\">Length</a>, but of either sign.</p>
</html>"));
