within PreloadedSprings.Icons;
partial package Package "Icon of a package"
  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {128, 128, 128}, fillColor = {245, 245, 240},
        fillPattern = FillPattern.Solid, radius = 20)}),
    Documentation(info = "<html>
<p>A sheet with rounded corners, on which extending packages draw their own icon.</p>
</html>"));
end Package;
