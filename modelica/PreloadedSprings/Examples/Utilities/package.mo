within PreloadedSprings.Examples;
package Utilities "What only the examples need"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Ellipse(extent = {{-40, 40}, {40, -40}}, lineColor = {64, 64, 64}, thickness = 1),
      Ellipse(extent = {{-12, 12}, {12, -12}}, lineColor = {64, 64, 64}, fillColor = {64, 64, 64},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>Sources of motions for the examples.</p>
</html>"));
end Utilities;
