within PreloadedSprings;
package Joystick "The joystick of the paper and its parts"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{0, -30}, {30, 50}}, color = {64, 64, 64}, thickness = 1),
      Ellipse(extent = {{16, 76}, {46, 46}}, lineColor = {64, 64, 64}, fillColor = {160, 60, 40},
        fillPattern = FillPattern.Solid),
      Polygon(points = {{-60, -26}, {52, -66}, {56, -54}, {-56, -14}, {-60, -26}}, lineColor = {64, 64, 64},
        fillColor = {192, 192, 192}, fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>Six models are made to be exported: <a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickPowerLaw\">JoystickPowerLaw</a> compute the motion under a
torque, with the two damping laws of the paper;
<a href=\"modelica://PreloadedSprings.Joystick.JoystickFriction\">JoystickFriction</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickFrictionPowerLaw\">JoystickFrictionPowerLaw</a> do so with dry
friction as well; <a href=\"modelica://PreloadedSprings.Joystick.JoystickInverse\">JoystickInverse</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickInversePowerLaw\">JoystickInversePowerLaw</a> compute the
torque for a motion. Their inputs, outputs and parameters have the same names. The other classes are their parts.</p>
</html>"));
end Joystick;
