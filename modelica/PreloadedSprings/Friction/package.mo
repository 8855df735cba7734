within PreloadedSprings;
package Friction "Dry friction of the joystick"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-50, 40}, {50, 0}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-80, 0}, {80, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-70, -24}, {-46, 0}}, color = {64, 64, 64}),
      Line(points = {{-34, -24}, {-10, 0}}, color = {64, 64, 64}),
      Line(points = {{2, -24}, {26, 0}}, color = {64, 64, 64}),
      Line(points = {{38, -24}, {62, 0}}, color = {64, 64, 64})}),
    Documentation(info = "<html>
<p>Coulomb and Stribeck friction of the pivot and Coulomb friction of the plungers, with sticking. The paper lumps
all losses into a damping moment that vanishes at rest; dry friction does not, so the joystick may come to rest
away from the middle. <a href=\"modelica://PreloadedSprings.Friction.StickSlip\">StickSlip</a> serves where the motion
is computed, <a href=\"modelica://PreloadedSprings.Friction.Prescribed\">Prescribed</a> where it is given; their
laws are those of <a href=\"modelica://PreloadedSprings.Interfaces.DryFriction\">Interfaces.DryFriction</a>.</p>
</html>"));
end Friction;
