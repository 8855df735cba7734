within PreloadedSprings.Joystick;
model JoystickPowerLaw "Joystick with damping by power laws (eq. 11): torque in, motion out (eq. 1)"
  extends Joystick(redeclare Damping.PowerLaw damping);

  annotation (
    defaultComponentName = "joystick",
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The same as <a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a>, with the damping
coefficient of eq. (11), <a href=\"modelica://PreloadedSprings.Damping.PowerLaw\">Damping.PowerLaw</a>. The
paper's best fit to its measurements has the weight <code>damping.alpha = 0.9</code>.</p>
</html>"));
end JoystickPowerLaw;
