within PreloadedSprings.Examples;
model ComponentAgainstTable "Load-deflection curves of both actuators, from springs and from tables (Fig. 7)"
  extends Icons.Example;
  Units.Force forwardDifference "Difference of the two forward forces";
  Units.Force backwardDifference "Difference of the two backward forces";
  Parts.Press press(v = 5e-3) "Testing machine"
    annotation (Placement(transformation(extent = {{-120, -20}, {-80, 20}})));
  Springs.ActuatorAssembly forward(
    returnSpring(k_s = 2625, k_h = 427375, F_0 = 52.7808125, x_0 = 0.075e-3),
    balanceSpring(k_s = 2975, k_h = 1022400, F_0 = 11.2464, x_0 = 2.932e-3)) "Forward actuator, from springs"
    annotation (Placement(transformation(extent = {{-20, 60}, {20, 100}})));
  Springs.TableAssembly forwardTable(
    x_i = {0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3}, k_i = {430e3, 2625, 1028e3, 5600})
    "Forward actuator, from Table 1"
    annotation (Placement(transformation(extent = {{-20, 10}, {20, 50}})));
  Springs.ActuatorAssembly backward(
    returnSpring(k_s = 1191, k_h = 657809, F_0 = 55.5848605, x_0 = 0.075e-3),
    balanceSpring(k_s = 2899, k_h = 1107910, F_0 = 9.97119, x_0 = 3.054e-3)) "Backward actuator, from springs"
    annotation (Placement(transformation(extent = {{-20, -50}, {20, -10}})));
  Springs.TableAssembly backwardTable(
    x_i = {0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3}, k_i = {659e3, 1191, 1112e3, 4090})
    "Backward actuator, from Table 1"
    annotation (Placement(transformation(extent = {{-20, -100}, {20, -60}})));
  Parts.Fixed wall "Table of the testing machine"
    annotation (Placement(transformation(origin = {100, 0}, extent = {{-20, -20}, {20, 20}}, rotation = 90)));
equation
  forwardDifference = forward.f - forwardTable.f;
  backwardDifference = backward.f - backwardTable.f;
  connect(press.flange, forward.flange_a)
    annotation (Line(points = {{-80, 0}, {-60, 0}, {-60, 80}, {-20, 80}}, color = {0, 127, 0}));
  connect(press.flange, forwardTable.flange_a)
    annotation (Line(points = {{-80, 0}, {-60, 0}, {-60, 30}, {-20, 30}}, color = {0, 127, 0}));
  connect(press.flange, backward.flange_a)
    annotation (Line(points = {{-80, 0}, {-60, 0}, {-60, -30}, {-20, -30}}, color = {0, 127, 0}));
  connect(press.flange, backwardTable.flange_a)
    annotation (Line(points = {{-80, 0}, {-60, 0}, {-60, -80}, {-20, -80}}, color = {0, 127, 0}));
  connect(forward.flange_b, wall.flange)
    annotation (Line(points = {{20, 80}, {60, 80}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(forwardTable.flange_b, wall.flange)
    annotation (Line(points = {{20, 30}, {60, 30}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(backward.flange_b, wall.flange)
    annotation (Line(points = {{20, -30}, {60, -30}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(backwardTable.flange_b, wall.flange)
    annotation (Line(points = {{20, -80}, {60, -80}, {60, 0}, {100, 0}}, color = {0, 127, 0}));

  annotation (
    Diagram(coordinateSystem(extent = {{-140, -120}, {140, 120}})),
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>A testing machine presses the joystick's two actuators by 7.5 mm. Plot <code>forward.f</code> and
<code>backward.f</code> over <code>press.s</code>: the curve of Fig. 7, with two steep and two gentle segments.
The same actuators, once from their springs and once from Table 1, give forces that differ by rounding only:
<code>forwardDifference</code> and <code>backwardDifference</code>.</p>
</html>"));
end ComponentAgainstTable;
