within PreloadedSpringsMSL.Components;
model OpposingSprings "Two opposing preloaded springs that center one flange to the other"
  extends Modelica.Mechanics.Translational.Interfaces.PartialTwoFlanges;
  parameter SI.TranslationalSpringConstant c(final min = 0, start = 2000) "Spring constant of either spring";
  parameter SI.TranslationalSpringConstant c_r(final min = 0, start = 4e5) "Spring constant of either restraint";
  parameter SI.Force f_preload(final min = 0, start = 40) "Preload of either spring";
  parameter SI.Distance clearance(final min = 0) = 0 "Play to either side of the middle";
  SI.Position s_rel "Relative distance (= flange_b.s - flange_a.s)";
  SI.Force f "Force between flanges (= flange_b.f)";
  PreloadedSpring shortening(final c = c, final c_r = c_r, final f_preload = f_preload, final s_rel0 = -clearance)
    "Spring that is compressed where s_rel is negative"
    annotation (Placement(transformation(extent = {{-20, 20}, {20, 60}})));
  PreloadedSpring lengthening(final c = c, final c_r = c_r, final f_preload = f_preload, final s_rel0 = -clearance)
    "Spring that is compressed where s_rel is positive"
    annotation (Placement(transformation(origin = {0, -40}, extent = {{-20, -20}, {20, 20}}, rotation = 180)));
equation
  s_rel = flange_b.s - flange_a.s;
  f = flange_b.f;
  connect(flange_a, shortening.flange_a)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, 40}, {-20, 40}}, color = {0, 127, 0}));
  connect(shortening.flange_b, flange_b)
    annotation (Line(points = {{20, 40}, {60, 40}, {60, 0}, {100, 0}}, color = {0, 127, 0}));
  connect(flange_a, lengthening.flange_b)
    annotation (Line(points = {{-100, 0}, {-60, 0}, {-60, -40}, {-20, -40}}, color = {0, 127, 0}));
  connect(lengthening.flange_a, flange_b)
    annotation (Line(points = {{20, -40}, {60, -40}, {60, 0}, {100, 0}}, color = {0, 127, 0}));

  annotation (
    defaultComponentName = "springs",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {90, 0}}, color = {0, 127, 0}),
      Rectangle(extent = {{-16, 30}, {16, -30}}, lineColor = {0, 127, 0}, fillColor = {160, 215, 160},
        fillPattern = FillPattern.Solid),
      Line(points = {{-74, 0}, {-68, 22}, {-60, -22}, {-52, 22}, {-44, -22}, {-36, 22}, {-30, 0}}, color = {0, 127, 0}),
      Line(points = {{74, 0}, {68, 22}, {60, -22}, {52, 22}, {44, -22}, {36, 22}, {30, 0}}, color = {0, 127, 0}),
      Line(points = {{-30, 36}, {-30, -36}}, color = {64, 64, 64}, thickness = 0.75),
      Line(points = {{30, 36}, {30, -36}}, color = {64, 64, 64}, thickness = 0.75),
      Text(extent = {{-150, 100}, {150, 60}}, textColor = {0, 0, 255}, textString = "%name"),
      Text(extent = {{-150, -75}, {150, -45}}, textString = "c=%c")}),
    Documentation(info = "<html>
<p>
One <a href=\"modelica://PreloadedSpringsMSL.Components.PreloadedSpring\">preloaded spring</a> is compressed where
<code>s_rel</code> is negative, the other where it is positive. Near the middle the force changes almost at once from
one preload to the opposite one; far out, the springs are soft. So the period of a body between them falls as its
amplitude falls.
</p>
</html>"));
end OpposingSprings;
