within PreloadedSprings.Examples;
model ForcedMotion "Torque for a motion forward and back, and the motion under that torque (Fig. 15)"
  extends Icons.Example;
  Units.Angle deviation "Difference of the motion under the torque from the motion that it was computed for";
  Utilities.ForwardAndReturn motion(theta_max = 15*Constants.pi/180, start_time = 0.1, duration = 0.3)
    "Motion of an operator"
    annotation (Placement(transformation(extent = {{-120, -20}, {-80, 20}})));
  Joystick.JoystickInverse inverse "Torque for the motion, constant damping"
    annotation (Placement(transformation(extent = {{-30, 10}, {30, 70}})));
  Joystick.JoystickInversePowerLaw inversePowerLaw "Torque for the motion, damping by power laws"
    annotation (Placement(transformation(extent = {{-30, -90}, {30, -30}})));
  Joystick.Joystick joystick "Joystick under the torque"
    annotation (Placement(transformation(extent = {{70, 30}, {130, 90}})));
equation
  deviation = joystick.theta - motion.theta;
  connect(motion.theta, inverse.theta)
    annotation (Line(points = {{-78, 12}, {-70, 12}, {-70, 58}, {-33, 58}}, color = {0, 0, 127}));
  connect(motion.omega, inverse.omega)
    annotation (Line(points = {{-78, 0}, {-60, 0}, {-60, 40}, {-33, 40}}, color = {0, 0, 127}));
  connect(motion.alpha, inverse.alpha)
    annotation (Line(points = {{-78, -12}, {-50, -12}, {-50, 22}, {-33, 22}}, color = {0, 0, 127}));
  connect(motion.theta, inversePowerLaw.theta)
    annotation (Line(points = {{-78, 12}, {-70, 12}, {-70, -42}, {-33, -42}}, color = {0, 0, 127}));
  connect(motion.omega, inversePowerLaw.omega)
    annotation (Line(points = {{-78, 0}, {-60, 0}, {-60, -60}, {-33, -60}}, color = {0, 0, 127}));
  connect(motion.alpha, inversePowerLaw.alpha)
    annotation (Line(points = {{-78, -12}, {-50, -12}, {-50, -78}, {-33, -78}}, color = {0, 0, 127}));
  connect(inverse.T, joystick.T)
    annotation (Line(points = {{33, 58}, {50, 58}, {50, 60}, {67, 60}}, color = {0, 0, 127}));

  annotation (
    Diagram(coordinateSystem(extent = {{-160, -120}, {160, 120}})),
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>An operator moves the joystick forward and back, here along an arbitrary curve. Plot <code>inverse.T</code> with
its shares <code>inverse.T_stiffness</code>, <code>inverse.T_damping</code> and <code>inverse.T_inertia</code>, the
four parts of Fig. 15: the inertia torque is comparable to that of springs and weight, and the damping is small.
<code>inversePowerLaw.T_damping</code> is about one and a half times as large.</p>
<p>The torque then drives a second joystick, which reproduces the prescribed motion: <code>deviation</code> is zero
except for integration errors.</p>
</html>"));
end ForcedMotion;
