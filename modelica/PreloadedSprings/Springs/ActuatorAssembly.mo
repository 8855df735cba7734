within PreloadedSprings.Springs;
model ActuatorAssembly "Return spring, and a balance spring that engages later, side by side"
  extends Interfaces.Compliant;
  RestrainedPreloadedSpring returnSpring "Return spring: engages after the clearance"
    annotation (Placement(transformation(extent = {{-30, 20}, {30, 80}})));
  RestrainedPreloadedSpring balanceSpring "Balance spring: engages when the rod bottoms out"
    annotation (Placement(transformation(extent = {{-30, -80}, {30, -20}})));
equation
  E = returnSpring.E + balanceSpring.E;
  connect(flange_a, returnSpring.flange_a)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, 50}, {-30, 50}}, color = {0, 127, 0}));
  connect(flange_a, balanceSpring.flange_a)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, -50}, {-30, -50}}, color = {0, 127, 0}));
  connect(returnSpring.flange_b, flange_b)
    annotation (Line(points = {{30, 50}, {60, 50}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(balanceSpring.flange_b, flange_b)
    annotation (Line(points = {{30, -50}, {60, -50}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
initial equation
  assert(balanceSpring.x_0 >= returnSpring.x_0, getInstanceName() + ".balanceSpring.x_0 must not be less than "
     + "returnSpring.x_0 = " + String(returnSpring.x_0) + " m, but is " + String(balanceSpring.x_0) + " m");

  annotation (
    defaultComponentName = "actuator",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-40, 50}, {90, -50}}, lineColor = {64, 64, 64}, fillColor = {235, 235, 235},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-74, 12}, {20, -12}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-90, 16}, {-58, -16}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-40, 32}, {-32, 44}, {-18, 20}, {-4, 44}, {10, 20}, {24, 44}, {38, 20}, {52, 44}, {66, 20},
        {80, 44}, {90, 32}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-40, -32}, {-32, -20}, {-18, -44}, {-4, -20}, {10, -44}, {24, -20}, {38, -44}, {52, -20},
        {66, -44}, {80, -20}, {90, -32}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{44, 0}, {48, 10}, {56, -10}, {64, 10}, {72, -10}, {80, 10}, {84, 0}, {90, 0}},
        color = {0, 127, 0}),
      Line(points = {{44, 16}, {44, -16}}, color = {64, 64, 64}, thickness = 0.5)}),
    Documentation(info = "<html>
<p>The plunger of the joystick with its two springs (Fig. 7). The return spring engages at its
<code>x_0</code>, the clearance; after about 3 mm the rod bottoms out and the balance spring engages at its
<code>x_0</code>. From there both act side by side, so their forces add up, and the load-deflection curve
has four segments:</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th>i</th><th>begins at x_i</th><th>stiffness k_i</th></tr>
<tr><td>0</td><td>returnSpring.x_0</td><td>returnSpring.k_h + returnSpring.k_s</td></tr>
<tr><td>1</td><td>x_0 + returnSpring.F_0/returnSpring.k_h</td><td>returnSpring.k_s</td></tr>
<tr><td>2</td><td>balanceSpring.x_0</td><td>returnSpring.k_s + balanceSpring.k_h + balanceSpring.k_s</td></tr>
<tr><td>3</td><td>x_2 + balanceSpring.F_0/balanceSpring.k_h</td><td>returnSpring.k_s + balanceSpring.k_s</td></tr>
</table>
<p>This is Table 1 of the paper, from which the springs' data follow:
<code>k_s = k_1</code>, <code>k_h = k_0 - k_1</code>, <code>F_0 = k_h*(x_1 - x_0)</code> for the return spring and
<code>k_s = k_3 - k_1</code>, <code>k_h = k_2 - k_3</code>, <code>F_0 = k_h*(x_3 - x_2)</code> for the balance
spring.</p>
</html>"));
end ActuatorAssembly;
