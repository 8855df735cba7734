within PreloadedSprings;
package Operator "The person who moves the joystick"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Ellipse(extent = {{-18, 66}, {18, 30}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{0, 30}, {0, -30}, {-24, -66}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{0, -30}, {24, -66}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{0, 14}, {30, -10}, {58, 4}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{58, 14}, {66, -44}}, color = {160, 60, 40}, thickness = 1)}),
    Documentation(info = "<html>
<p>Section 5 of the paper asks for the torque that an operator must apply so that the joystick makes a given
motion. Here the operator is a mechanical part of the system: a hand and arm with stiffness and damping whose
rest position makes the wanted motion. What the joystick then does, and the torque, follow from both.</p>
</html>"));
end Operator;
