within PreloadedSpringsMSL.Examples;
model OpposingSprings "Mass between two opposing preloaded springs"
  extends Modelica.Icons.Example;
  Modelica.Mechanics.Translational.Components.Fixed fixed "Frame"
    annotation (Placement(transformation(origin = {-80, 0}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  Components.OpposingSprings springs(c = 2000, c_r = 4e5, f_preload = 40, clearance = 0.5e-3) "Springs of the mass"
    annotation (Placement(transformation(extent = {{-40, -10}, {-20, 10}})));
  Modelica.Mechanics.Translational.Components.Mass mass(m = 0.5, s(start = 4e-3, fixed = true),
    v(start = 0, fixed = true)) "Mass, released off center"
    annotation (Placement(transformation(extent = {{20, -10}, {40, 10}})));
  Modelica.Mechanics.Translational.Components.Damper damper(d = 3) "Losses in the guide of the mass"
    annotation (Placement(transformation(extent = {{-40, -50}, {-20, -30}})));
equation
  connect(fixed.flange, springs.flange_a)
    annotation (Line(points = {{-80, 0}, {-40, 0}}, color = {0, 127, 0}));
  connect(springs.flange_b, mass.flange_a)
    annotation (Line(points = {{-20, 0}, {20, 0}}, color = {0, 127, 0}));
  connect(fixed.flange, damper.flange_a)
    annotation (Line(points = {{-80, 0}, {-60, 0}, {-60, -40}, {-40, -40}}, color = {0, 127, 0}));
  connect(damper.flange_b, mass.flange_a)
    annotation (Line(points = {{-20, -40}, {0, -40}, {0, 0}, {20, 0}}, color = {0, 127, 0}));

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>
The system of
<a href=\"modelica://PreloadedSprings.Examples.OpposingSprings\">PreloadedSprings.Examples.OpposingSprings</a> with
components of the Modelica Standard Library; its motion is the same. Plot <code>mass.s</code>: the period falls as
the amplitude falls. Plot <code>springs.f</code> over <code>mass.s</code> to see the spring characteristic.
</p>
</html>"));
end OpposingSprings;
