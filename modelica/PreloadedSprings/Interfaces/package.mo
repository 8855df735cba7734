within PreloadedSprings;
package Interfaces "Connectors and partial components"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-70, 20}, {-30, -20}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid),
      Line(points = {{-30, 0}, {30, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Ellipse(extent = {{30, 20}, {70, -20}}, lineColor = {64, 64, 64}, fillColor = {128, 128, 128},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>The two physical connectors carry a potential and a flow: position and force along a line, angle and
torque about an axis. They are the pairs that the Modelica Standard Library uses, so that components of
both can be connected. The partial components are what springs and damping laws are extended from.</p>
</html>"));
end Interfaces;
