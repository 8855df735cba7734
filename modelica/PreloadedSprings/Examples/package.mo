within PreloadedSprings;
package Examples "Models that can be simulated as they are"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Polygon(points = {{-36, 60}, {64, 0}, {-36, -60}, {-36, 60}}, lineColor = {75, 138, 73},
        fillColor = {75, 138, 73}, fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>Each example is complete and includes its simulation settings; its documentation says what to plot.</p>
</html>"));
end Examples;
