within PreloadedSprings.Joystick;
partial model Mechanism "Handle, cam plate with its two actuators, and weight on one shaft"
  parameter Units.MomentOfInertia J = 0.01135 "Mass moment of inertia about the pivot"
    annotation (Dialog(group = "Handle"));
  parameter Units.Mass m = 0.87 "Mass of the handle"
    annotation (Dialog(group = "Handle"));
  parameter Units.Length h = 0.082 "Distance from the pivot to the center of mass"
    annotation (Dialog(group = "Handle"));
  parameter Units.Acceleration g(min = 0) = 9.80665 "Acceleration of gravity"
    annotation (Dialog(group = "Handle"));
  parameter Units.Length a(min = Constants.small) = 0.02398 "Distance from the pivot to the plunger axes"
    annotation (Dialog(group = "Cam plate"));
  parameter Units.Length b = 0.005 "Distance from the pivot to the cam surface"
    annotation (Dialog(group = "Cam plate"));
  Springs.ActuatorAssembly forward(
    returnSpring(k_s = 2625, k_h = 427375, F_0 = 52.7808125, x_0 = 0.075e-3),
    balanceSpring(k_s = 2975, k_h = 1022400, F_0 = 11.2464, x_0 = 2.932e-3))
    "Actuator that is pushed at positive angles"
    annotation (Placement(transformation(origin = {32, -150}, extent = {{-20, -20}, {20, 20}}, rotation = -90)));
  Springs.ActuatorAssembly backward(
    returnSpring(k_s = 1191, k_h = 657809, F_0 = 55.5848605, x_0 = 0.075e-3),
    balanceSpring(k_s = 2899, k_h = 1107910, F_0 = 9.97119, x_0 = 3.054e-3))
    "Actuator that is pushed at negative angles"
    annotation (Placement(transformation(origin = {-32, -150}, extent = {{-20, -20}, {20, 20}}, rotation = -90)));
protected
  constant Units.Angle theta_limit = Constants.pi/2 "Angle at which the handle lies flat";
  Handle handle(final J = J) "Inertia of the handle"
    annotation (Placement(transformation(extent = {{-30, 80}, {30, 140}})));
  Gravity gravity(final m = m, final h = h, final g = g) "Weight of the handle"
    annotation (Placement(transformation(extent = {{-20, 160}, {20, 200}})));
  CamPlate camPlate(final a = a, final b = b) "Cam plate under the handle"
    annotation (Placement(transformation(extent = {{-40, -110}, {40, -30}})));
  Parts.Fixed housing "Housing of the actuators"
    annotation (Placement(transformation(extent = {{-20, -205}, {20, -165}})));
equation
  connect(gravity.flange, camPlate.flange)
    annotation (Line(points = {{-20, 180}, {-80, 180}, {-80, -70}, {-40, -70}}, color = {64, 64, 64}));
  connect(handle.flange, camPlate.flange)
    annotation (Line(points = {{-30, 110}, {-80, 110}, {-80, -70}, {-40, -70}}, color = {64, 64, 64}));
  connect(camPlate.flange_forward, forward.flange_a)
    annotation (Line(points = {{32, -110}, {32, -130}}, color = {0, 127, 0}));
  connect(camPlate.flange_backward, backward.flange_a)
    annotation (Line(points = {{-32, -110}, {-32, -130}}, color = {0, 127, 0}));
  connect(forward.flange_b, housing.flange)
    annotation (Line(points = {{32, -170}, {32, -185}, {0, -185}}, color = {0, 127, 0}));
  connect(backward.flange_b, housing.flange)
    annotation (Line(points = {{-32, -170}, {-32, -185}, {0, -185}}, color = {0, 127, 0}));

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {64, 64, 64}, fillColor = {250, 250, 250},
        fillPattern = FillPattern.Solid),
      Polygon(points = {{-10, -16}, {18, 40}, {30, 34}, {4, -24}, {-10, -16}}, lineColor = {64, 64, 64},
        fillColor = {192, 192, 192}, fillPattern = FillPattern.Solid),
      Polygon(points = {{10, 38}, {30, 78}, {46, 84}, {58, 70}, {36, 24}, {10, 38}}, lineColor = {64, 64, 64},
        fillColor = {160, 60, 40}, fillPattern = FillPattern.Solid),
      Rectangle(extent = {{38, -52}, {50, -88}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-50, -30}, {-38, -88}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Polygon(points = {{-60, -16}, {54, -60}, {60, -48}, {-54, -4}, {-60, -16}}, lineColor = {64, 64, 64},
        fillColor = {192, 192, 192}, fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-12, -16}, {12, -40}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-70, -88}, {70, -88}}, color = {64, 64, 64}, thickness = 0.5),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Diagram(coordinateSystem(extent = {{-220, -220}, {220, 220}})),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Joystick.Joystick\">Joystick</a> and
<a href=\"modelica://PreloadedSprings.Joystick.JoystickInverse\">JoystickInverse</a> have in common: the shaft
through the pivot with everything that acts on it, apart from the damping and from the torque or motion that
comes from outside. The preset values are Tables 1 and 2 of the paper, with the springs' data computed from
Table 1 as <a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">ActuatorAssembly</a> says.</p>
</html>"));
end Mechanism;
