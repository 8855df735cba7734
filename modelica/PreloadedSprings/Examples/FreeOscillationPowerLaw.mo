within PreloadedSprings.Examples;
model FreeOscillationPowerLaw "Joystick with damping by power laws, released from -20 degrees (Fig. 10)"
  extends Icons.Example;
  Joystick.JoystickPowerLaw joystick(T = 0, theta_start = -20*Constants.pi/180) "Joystick, released"
    annotation (Placement(transformation(extent = {{-40, -40}, {40, 40}})));

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>As <a href=\"modelica://PreloadedSprings.Examples.FreeOscillation\">FreeOscillation</a>, with the damping
coefficient of eq. (11). Plot <code>joystick.C</code> to see its jumps where the angle changes its sign
(Fig. 13).</p>
</html>"));
end FreeOscillationPowerLaw;
