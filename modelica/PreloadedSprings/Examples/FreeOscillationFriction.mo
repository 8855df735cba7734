within PreloadedSprings.Examples;
model FreeOscillationFriction "Free oscillation from 20 degrees that dry friction ends"
  extends Icons.Example;
  Joystick.JoystickFriction joystick(theta_start = -0.3490658503988659, friction(T_c = 0.05), T = 0)
    "Released at 20 degrees backward, at rest"
    annotation (Placement(transformation(extent = {{-40, -40}, {40, 40}})));

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>As in <a href=\"modelica://PreloadedSprings.Examples.FreeOscillation\">FreeOscillation</a>, the joystick is held at
rest and released. The dry friction of its pivot, 0.05 N.m, takes energy from every swing, so the peaks fall faster
than exponentially. After 1.18 s the joystick sticks.</p>
</html>"));
end FreeOscillationFriction;
