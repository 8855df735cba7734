package PreloadedSpringsMSL "Preloaded springs and joysticks among components of the Modelica Standard Library"
  extends Modelica.Icons.Package;
  import Modelica.Units.SI;

  annotation (
    preferredView = "info",
    version = "1.0.0",
    versionDate = "2026-11-23",
    uses(Modelica(version = "4.0.0"), PreloadedSprings(version = "1.0.0")),
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-22, 26}, {22, -26}}, lineColor = {0, 127, 0}, fillColor = {160, 215, 160},
        fillPattern = FillPattern.Solid),
      Line(points = {{-84, 0}, {-76, 22}, {-66, -22}, {-56, 22}, {-46, -22}, {-36, 22}, {-32, 0}}, color = {0, 127, 0}),
      Line(points = {{84, 0}, {76, 22}, {66, -22}, {56, 22}, {46, -22}, {36, 22}, {32, 0}}, color = {0, 127, 0}),
      Line(points = {{-32, 30}, {-32, -30}}, color = {64, 64, 64}),
      Line(points = {{32, 30}, {32, -30}}, color = {64, 64, 64})}),
    Documentation(info = "<html>
<p>
<a href=\"modelica://PreloadedSprings\">PreloadedSprings</a> needs no other library. This one connects it to the
Modelica Standard Library: springs on the flanges of
<a href=\"modelica://Modelica.Mechanics.Translational\">Modelica.Mechanics.Translational</a>, and joysticks that
motors and gears of the Modelica Standard Library load and drive.
</p>
<p>
Signs and names are those of the Modelica Standard Library: <code>s_rel = flange_b.s - flange_a.s</code> falls where a
spring is compressed, its force <code>f</code> is then negative, <code>c</code> is a spring constant and
<code>s_rel0</code> the relative distance at which the contact begins.
</p>
<p>
The joysticks themselves need no MSL version: the <code>flange</code> of
<a href=\"modelica://PreloadedSprings.Joystick.Joystick\">PreloadedSprings.Joystick.Joystick</a> connects to those of
<a href=\"modelica://Modelica.Mechanics.Rotational\">Modelica.Mechanics.Rotational</a>, and its signals to those of
<a href=\"modelica://Modelica.Blocks\">Modelica.Blocks</a>.
</p>
</html>"));
end PreloadedSpringsMSL;
