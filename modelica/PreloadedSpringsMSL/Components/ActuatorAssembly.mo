within PreloadedSpringsMSL.Components;
model ActuatorAssembly "Return spring, and a balance spring that engages later, side by side"
  extends Modelica.Mechanics.Translational.Interfaces.PartialTwoFlanges;
  SI.Position s_rel "Relative distance (= flange_b.s - flange_a.s)";
  SI.Force f "Force between flanges (= flange_b.f)";
  PreloadedSpring returnSpring(c = 2625, c_r = 427375, f_preload = 52.7808125, s_rel0 = -0.075e-3)
    "Return spring: engages after the clearance"
    annotation (Placement(transformation(extent = {{-20, 20}, {20, 60}})));
  PreloadedSpring balanceSpring(c = 2975, c_r = 1022400, f_preload = 11.2464, s_rel0 = -2.932e-3)
    "Balance spring: engages when the rod bottoms out"
    annotation (Placement(transformation(extent = {{-20, -60}, {20, -20}})));
equation
  s_rel = flange_b.s - flange_a.s;
  f = flange_b.f;
  connect(flange_a, returnSpring.flange_a)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, 40}, {-20, 40}}, color = {0, 127, 0}));
  connect(flange_a, balanceSpring.flange_a)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, -40}, {-20, -40}}, color = {0, 127, 0}));
  connect(returnSpring.flange_b, flange_b)
    annotation (Line(points = {{20, 40}, {60, 40}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(balanceSpring.flange_b, flange_b)
    annotation (Line(points = {{20, -40}, {60, -40}, {60, 0}, {100, 0}}, color = {0, 127, 0}));

  annotation (
    defaultComponentName = "actuator",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {90, 0}}, color = {0, 127, 0}),
      Rectangle(extent = {{-40, 50}, {90, -50}}, lineColor = {64, 64, 64}, fillColor = {235, 235, 235},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-74, 12}, {20, -12}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-40, 32}, {-32, 44}, {-18, 20}, {-4, 44}, {10, 20}, {24, 44}, {38, 20}, {52, 44}, {66, 20},
        {80, 44}, {90, 32}}, color = {0, 127, 0}),
      Line(points = {{-40, -32}, {-32, -20}, {-18, -44}, {-4, -20}, {10, -44}, {24, -20}, {38, -44}, {52, -20},
        {66, -44}, {80, -20}, {90, -32}}, color = {0, 127, 0}),
      Text(extent = {{-150, 100}, {150, 60}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>
The plunger of the joystick: two
<a href=\"modelica://PreloadedSpringsMSL.Components.PreloadedSpring\">preloaded springs</a> side by side, of which the
second engages after about 3 mm. The preset values are the forward side of
<a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">PreloadedSprings.Springs.ActuatorAssembly</a>.
</p>
</html>"));
end ActuatorAssembly;
