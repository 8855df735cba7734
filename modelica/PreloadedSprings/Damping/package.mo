within PreloadedSprings;
package Damping "Damping laws of the joystick"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-70, 0}, {-14, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{50, 40}, {-40, 40}, {-40, -40}, {50, -40}}, color = {64, 64, 64}, thickness = 0.5),
      Rectangle(extent = {{-14, 30}, {10, -30}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>Section 3.3 of the paper lumps all energy losses into one damping moment. Its coefficient is
<a href=\"modelica://PreloadedSprings.Damping.Constant\">constant</a> or depends on angle and angular velocity
by <a href=\"modelica://PreloadedSprings.Damping.PowerLaw\">power laws</a>. A law of your own extends
<a href=\"modelica://PreloadedSprings.Interfaces.DampingLaw\">Interfaces.DampingLaw</a> and replaces
<code>damping</code> in the joystick.</p>
</html>"));
end Damping;
