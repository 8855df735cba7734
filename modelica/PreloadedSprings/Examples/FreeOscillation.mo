within PreloadedSprings.Examples;
model FreeOscillation "Joystick with constant damping, released from -20 degrees (Fig. 10)"
  extends Icons.Example;
  Joystick.Joystick joystick(T = 0, theta_start = -20*Constants.pi/180) "Joystick, released"
    annotation (Placement(transformation(extent = {{-40, -40}, {40, 40}})));

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The joystick is held backward and released; no torque acts on it. Plot <code>joystick.theta</code>,
<code>joystick.omega</code> and <code>joystick.alpha</code>, the three parts of Fig. 10, and <code>joystick.E</code>
(Fig. 12).</p>
</html>"));
end FreeOscillation;
