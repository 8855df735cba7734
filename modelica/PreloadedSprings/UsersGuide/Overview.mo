within PreloadedSprings.UsersGuide;
class Overview "Overview"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<p>A spring that is compressed against a restraint exerts no force until something pushes it further than its
preload. A body between two such springs stays in the middle under small forces and needs little additional
force for large travel. Joysticks, snubbers and switches are built that way.</p>
<h4>To simulate the paper's joystick</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th>Purpose</th><th>Model</th></tr>
<tr><td>motion under a torque, constant damping</td>
<td><a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick.Joystick</a></td></tr>
<tr><td>motion under a torque, damping by eq. (11)</td>
<td><a href=\"modelica://PreloadedSprings.Joystick.JoystickPowerLaw\">Joystick.JoystickPowerLaw</a></td></tr>
<tr><td>the same with dry friction</td>
<td><a href=\"modelica://PreloadedSprings.Joystick.JoystickFriction\">Joystick.JoystickFriction</a>,
<a href=\"modelica://PreloadedSprings.Joystick.JoystickFrictionPowerLaw\">Joystick.JoystickFrictionPowerLaw</a></td>
</tr>
<tr><td>torque that a motion needs</td>
<td><a href=\"modelica://PreloadedSprings.Joystick.JoystickInverse\">Joystick.JoystickInverse</a>,
<a href=\"modelica://PreloadedSprings.Joystick.JoystickInversePowerLaw\">Joystick.JoystickInversePowerLaw</a></td></tr>
<tr><td>with stops, in a hand, on a base that moves</td>
<td><a href=\"modelica://PreloadedSprings.Operator.MountedJoystick\">Operator.MountedJoystick</a>,
<a href=\"modelica://PreloadedSprings.Operator.MountedJoystickPowerLaw\">Operator.MountedJoystickPowerLaw</a></td></tr>
</table>
<p>The <a href=\"modelica://PreloadedSprings.Examples\">examples</a> show all of them.</p>
<h4>To build a system of your own</h4>
<p>Connect <a href=\"modelica://PreloadedSprings.Springs\">springs</a> and
<a href=\"modelica://PreloadedSprings.Parts\">masses and walls</a> by their flanges, as
<a href=\"modelica://PreloadedSprings.Examples.OpposingSprings\">OpposingSprings</a> does. A measured
load-deflection curve becomes a
<a href=\"modelica://PreloadedSprings.Springs.TableAssembly\">TableAssembly</a>. Motors and loads connect to the
<code>flange</code> of a joystick; <code>PreloadedSpringsMSL</code> shows this with components of the Modelica
Standard Library. For a damping law of your own,
extend <a href=\"modelica://PreloadedSprings.Interfaces.DampingLaw\">Interfaces.DampingLaw</a> and write
<code>Joystick(redeclare MyLaw damping)</code>.</p>
</html>"));
end Overview;
