within PreloadedSpringsMSL.Examples;
model ActuatorLoadCurve "Load-deflection curve of an actuator, on either library's flanges"
  extends Modelica.Icons.Example;
  Modelica.Mechanics.Translational.Sources.ConstantSpeed press(v_fixed = 3e-3, s(start = 0, fixed = true))
    "Crosshead of a testing machine"
    annotation (Placement(transformation(extent = {{-60, -10}, {-40, 10}})));
  Components.ActuatorAssembly actuator "Actuator on flanges of the Modelica Standard Library"
    annotation (Placement(transformation(extent = {{0, 20}, {20, 40}})));
  PreloadedSprings.Springs.ActuatorAssembly original(
    returnSpring(k_s = 2625, k_h = 427375, F_0 = 52.7808125, x_0 = 0.075e-3),
    balanceSpring(k_s = 2975, k_h = 1022400, F_0 = 11.2464, x_0 = 2.932e-3)) "Actuator of PreloadedSprings"
    annotation (Placement(transformation(extent = {{0, -40}, {20, -20}})));
  Modelica.Mechanics.Translational.Components.Fixed fixed "Bed of the testing machine"
    annotation (Placement(transformation(origin = {60, 0}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
equation
  connect(press.flange, actuator.flange_a)
    annotation (Line(points = {{-40, 0}, {-20, 0}, {-20, 30}, {0, 30}}, color = {0, 127, 0}));
  connect(press.flange, original.flange_a)
    annotation (Line(points = {{-40, 0}, {-20, 0}, {-20, -30}, {0, -30}}, color = {0, 127, 0}));
  connect(actuator.flange_b, fixed.flange)
    annotation (Line(points = {{20, 30}, {40, 30}, {40, 0}, {60, 0}}, color = {0, 127, 0}));
  connect(original.flange_b, fixed.flange)
    annotation (Line(points = {{20, -30}, {40, -30}, {40, 0}, {60, 0}}, color = {0, 127, 0}));

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>
A press compresses the joystick's actuator twice: with
<a href=\"modelica://PreloadedSpringsMSL.Components.PreloadedSpring\">springs</a> of this library and with those of
<a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">PreloadedSprings</a>, whose flanges connect to those of
the Modelica Standard Library. Plot <code>actuator.f</code> and <code>original.f</code> over <code>press.s</code>: they
have opposite signs and are otherwise equal.
</p>
</html>"));
end ActuatorLoadCurve;
