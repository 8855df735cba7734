within PreloadedSprings.Icons;
partial class Package "Icon of a package"
  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {128, 128, 128}, fillColor = {245, 245, 240},
        fillPattern = FillPattern.Solid, radius = 20),
      Line(points = {{-100, 72}, {100, 72}}, color = {128, 128, 128})}),
    Documentation(info = "<html>
<p>A sheet with a ribbon; packages add a picture of their own.</p>
</html>"));
end Package;
