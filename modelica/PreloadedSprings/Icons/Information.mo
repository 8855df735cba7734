within PreloadedSprings.Icons;
partial class Information "Icon of a class that holds documentation only"
  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Ellipse(extent = {{-90, 90}, {90, -90}}, lineColor = {40, 90, 140}, fillColor = {40, 90, 140},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-13, 66}, {13, 40}}, pattern = LinePattern.None, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Polygon(points = {{-26, 24}, {13, 24}, {13, -44}, {30, -44}, {30, -60}, {-30, -60}, {-30, -44}, {-13, -44},
        {-13, 8}, {-26, 8}, {-26, 24}}, pattern = LinePattern.None, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>The letter i in a circle.</p>
</html>"));
end Information;
