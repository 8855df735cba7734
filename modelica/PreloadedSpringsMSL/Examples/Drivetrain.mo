within PreloadedSpringsMSL.Examples;
model Drivetrain "Joystick at the end of a drivetrain: rotor, gear and elastic shaft"
  extends Modelica.Icons.Example;
  Modelica.Blocks.Sources.Sine sine(amplitude = 0.2, f = 2) "Torque of the motor"
    annotation (Placement(transformation(extent = {{-160, -10}, {-140, 10}})));
  Modelica.Mechanics.Rotational.Sources.Torque torque "Motor"
    annotation (Placement(transformation(extent = {{-120, -10}, {-100, 10}})));
  Modelica.Mechanics.Rotational.Components.Inertia rotor(J = 2e-5, phi(start = 0, fixed = true),
    w(start = 0, fixed = true)) "Rotor of the motor"
    annotation (Placement(transformation(extent = {{-80, -10}, {-60, 10}})));
  Modelica.Mechanics.Rotational.Components.IdealGear gear(ratio = 8) "Gear"
    annotation (Placement(transformation(extent = {{-40, -10}, {-20, 10}})));
  Modelica.Mechanics.Rotational.Components.SpringDamper shaft(c = 40, d = 0.05) "Elastic shaft"
    annotation (Placement(transformation(extent = {{0, -10}, {20, 10}})));
  PreloadedSprings.Joystick.Joystick joystick(T = 0) "Joystick"
    annotation (Placement(transformation(extent = {{60, -20}, {120, 40}})));
equation
  connect(sine.y, torque.tau)
    annotation (Line(points = {{-139, 0}, {-122, 0}}, color = {0, 0, 127}));
  connect(torque.flange, rotor.flange_a)
    annotation (Line(points = {{-100, 0}, {-80, 0}}));
  connect(rotor.flange_b, gear.flange_a)
    annotation (Line(points = {{-60, 0}, {-40, 0}}));
  connect(gear.flange_b, shaft.flange_a)
    annotation (Line(points = {{-20, 0}, {0, 0}}));
  connect(shaft.flange_b, joystick.flange)
    annotation (Line(points = {{20, 0}, {40, 0}, {40, -14}, {60, -14}}));

  annotation (
    Diagram(coordinateSystem(extent = {{-180, -100}, {180, 100}})),
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>
A motor moves the joystick to and fro through a gear and an elastic shaft. Plot
<code>joystick.theta</code> and <code>rotor.phi</code>; <code>shaft.phi_rel</code> is the twist of the shaft.
</p>
</html>"));
end Drivetrain;
