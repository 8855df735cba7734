within PreloadedSprings.Examples;
model OpposingSprings "Mass between two opposing restrained preloaded springs (Fig. 1)"
  extends Icons.Example;
  parameter Units.Length clearance = 0.5e-3 "Play between the centered mass and each spring";
  Units.Energy E "Energy of the mass and the springs";
  Parts.Mass mass(m = 0.5, s(start = 4e-3, fixed = true), v(start = 0, fixed = true)) "Mass, released off center"
    annotation (Placement(transformation(extent = {{-20, 0}, {20, 40}})));
  Springs.RestrainedPreloadedSpring leftSpring(k_s = 2000, k_h = 4e5, F_0 = 40, x_0 = clearance)
    "Spring that is compressed where the mass is left of the middle"
    annotation (Placement(transformation(extent = {{-80, 0}, {-40, 40}})));
  Springs.RestrainedPreloadedSpring rightSpring(k_s = 2000, k_h = 4e5, F_0 = 40, x_0 = clearance)
    "Spring that is compressed where the mass is right of the middle"
    annotation (Placement(transformation(extent = {{40, 0}, {80, 40}})));
  Parts.Damper damper(d = 3) "Losses in the guide of the mass"
    annotation (Placement(transformation(extent = {{40, -60}, {80, -20}})));
  Parts.Fixed leftWall "Wall behind the left spring"
    annotation (Placement(transformation(origin = {-100, 20}, extent = {{-20, -20}, {20, 20}}, rotation = -90)));
  Parts.Fixed rightWall "Wall behind the right spring"
    annotation (Placement(transformation(origin = {100, 20}, extent = {{-20, -20}, {20, 20}}, rotation = 90)));
equation
  E = mass.E + leftSpring.E + rightSpring.E;
  connect(leftWall.flange, leftSpring.flange_a)
    annotation (Line(points = {{-100, 20}, {-80, 20}}, color = {0, 127, 0}));
  connect(leftSpring.flange_b, mass.flange_a)
    annotation (Line(points = {{-40, 20}, {-20, 20}}, color = {0, 127, 0}));
  connect(mass.flange_b, rightSpring.flange_a)
    annotation (Line(points = {{20, 20}, {40, 20}}, color = {0, 127, 0}));
  connect(rightSpring.flange_b, rightWall.flange)
    annotation (Line(points = {{80, 20}, {100, 20}}, color = {0, 127, 0}));
  connect(mass.flange_b, damper.flange_a)
    annotation (Line(points = {{20, 20}, {30, 20}, {30, -40}, {40, -40}}, color = {0, 127, 0}));
  connect(damper.flange_b, rightWall.flange)
    annotation (Line(points = {{80, -40}, {90, -40}, {90, 20}, {100, 20}}, color = {0, 127, 0}));

  annotation (
    Diagram(coordinateSystem(extent = {{-140, -80}, {140, 80}})),
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>The system that the paper starts from: a mass moves through a clearance to contact with one or the other of two
springs, each kept compressed by its central rod. In the middle, the force jumps almost from one preload to the other;
far out, the springs are soft.</p>
<p>Plot <code>mass.s</code>: the period falls as the amplitude falls. Plot <code>E</code>: it never rises.
<a href=\"modelica://PreloadedSprings.Examples.OpposingSpringsWithoutClearance\">OpposingSpringsWithoutClearance</a>
is the same without play.</p>
</html>"));
end OpposingSprings;
