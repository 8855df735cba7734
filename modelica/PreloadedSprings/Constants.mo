within PreloadedSprings;
package Constants "Mathematical constants"
  extends Icons.Package;
  constant Units.Ratio pi = 3.14159265358979323846 "Ratio of a circle's circumference to its diameter";
  constant Units.Ratio small = 1e-60 "Least value of what must be positive, since the attribute min includes its value";

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-50, 40}, {50, 40}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{-20, 40}, {-24, -10}, {-36, -50}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{22, 40}, {22, -36}, {30, -50}, {44, -44}}, color = {64, 64, 64}, thickness = 1)}),
    Documentation(info = "<html>
<p>The constants that the library needs, since it uses no other library.</p>
</html>"));
end Constants;
