within PreloadedSprings;
package Constants "Mathematical constants"
  extends PreloadedSprings.Icons.Package;

  final constant Real pi = 3.14159265358979323846 "Half the circumference of the unit circle";

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-50, 40}, {50, 40}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{-20, 40}, {-20, 0}, {-32, -50}}, color = {64, 64, 64}, thickness = 1, smooth = Smooth.Bezier),
      Line(points = {{22, 40}, {22, -40}, {30, -50}, {42, -44}}, color = {64, 64, 64}, thickness = 1,
        smooth = Smooth.Bezier)}),
    Documentation(info = "<html>
<p>The constants that the library needs; it uses no other library.</p>
</html>"));
end Constants;
