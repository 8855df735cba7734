within PreloadedSprings;
package Icons "Icons that several classes share"
  extends PreloadedSprings.Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-70, -40}, {-30, 30}, {0, -10}, {20, 15}, {70, -40}, {-70, -40}}, lineColor = {75, 138, 73},
        fillColor = {150, 195, 148}, fillPattern = FillPattern.Solid),
      Ellipse(extent = {{26, 62}, {54, 34}}, lineColor = {200, 150, 40}, fillColor = {240, 200, 90},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>Partial classes that contain only an icon.</p>
</html>"));
end Icons;
