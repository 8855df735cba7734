within PreloadedSprings.Examples;
model OperatedJoystick "Operator and joystick as one system"
  extends Icons.Example;
  Operator.Operator operator_ "Person who moves the joystick"
    annotation (Placement(transformation(extent = {{-100, -40}, {-20, 40}})));
  Joystick.Joystick joystick "Joystick of the paper"
    annotation (Placement(transformation(extent = {{40, -40}, {120, 40}})));
equation
  connect(operator_.T, joystick.T)
    annotation (Line(points = {{-16, 24}, {10, 24}, {10, 0}, {36, 0}}, color = {0, 0, 127}));
  connect(joystick.theta, operator_.theta)
    annotation (Line(points = {{123, 36}, {140, 36}, {140, 80}, {-120, 80}, {-120, 16}, {-104, 16}},
      color = {0, 0, 127}));
  connect(joystick.omega, operator_.omega)
    annotation (Line(points = {{123, 28}, {150, 28}, {150, 90}, {-130, 90}, {-130, -16}, {-104, -16}},
      color = {0, 0, 127}));

  annotation (
    Diagram(coordinateSystem(extent = {{-160, -120}, {160, 120}})),
    experiment(StartTime = 0, StopTime = 1.2, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The operator moves the joystick by 15 degrees forward, holds it, and lets it return. Plot
<code>joystick.theta</code> with <code>operator_.theta_ref</code>: the joystick lags, most where the preload begins to
act. The energy balance <code>operator_.W = joystick.E</code> plus the loss by damping holds.</p>
<p>As two FMUs, the same models form a co-simulation that exchanges torque and motion only at communication points.
This model has no such points and serves as the reference for it.</p>
</html>"));
end OperatedJoystick;
