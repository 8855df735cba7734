within PreloadedSpringsMSL.Components;
model PreloadedSpring "1D translational spring that a restraint keeps compressed until a force exceeds the preload"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliant;
  parameter SI.TranslationalSpringConstant c(final min = 0, start = 2625) "Spring constant";
  parameter SI.TranslationalSpringConstant c_r(final min = 0, start = 427375)
    "Spring constant of the restraint (rod or housing)";
  parameter SI.Force f_preload(final min = 0, start = 52.7808125) "Preload";
  parameter SI.Position s_rel0 = 0 "Relative distance at which the contact begins";
  SI.Position s_compressed "Compression from the preloaded position, negative without contact";
  Boolean contact "= true, if contact, otherwise no contact";
  Boolean released "= true, if the restraint carries no force any more";
equation
  s_compressed = s_rel0 - s_rel;
  contact = s_rel < s_rel0;
  released = c_r*s_compressed > f_preload;
  f = if released then -(f_preload + c*s_compressed) elseif contact then -(c + c_r)*s_compressed else 0;

  annotation (
    defaultComponentName = "spring",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {-84, 0}}, color = {0, 127, 0}),
      Line(points = {{-84, 26}, {-84, -26}}, color = {0, 127, 0}),
      Line(points = {{-64, 0}, {64, 0}}, color = {128, 128, 128}),
      Rectangle(extent = {{-74, 10}, {-62, -10}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-62, 46}, {-62, -46}}, color = {64, 64, 64}, thickness = 0.75),
      Line(points = {{62, 46}, {62, -46}}, color = {64, 64, 64}, thickness = 0.75),
      Line(points = {{-62, 0}, {-54, 34}, {-38, -34}, {-22, 34}, {-6, -34}, {10, 34}, {26, -34}, {42, 34}, {54, -34},
        {62, 0}}, color = {0, 127, 0}),
      Line(points = {{62, 0}, {90, 0}}, color = {0, 127, 0}),
      Line(points = {{-60, -80}, {20, -80}}, color = {95, 127, 95}),
      Polygon(points = {{50, -80}, {20, -70}, {20, -90}, {50, -80}}, lineColor = {95, 127, 95},
        fillColor = {95, 127, 95}, fillPattern = FillPattern.Solid),
      Text(extent = {{-150, 100}, {150, 60}}, textColor = {0, 0, 255}, textString = "%name"),
      Text(extent = {{-150, -125}, {150, -95}}, textString = "c=%c")}),
    Documentation(info = "<html>
<p>
A spring of the constant <code>c</code> that a restraint of the constant <code>c_r</code>, a central rod or the housing,
holds compressed with the force <code>f_preload</code>. With the compression
<code>s_compressed = s_rel0 - s_rel</code> from the preloaded position, the force is
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>State</th><th>Condition</th><th>Force</th></tr>
<tr><td>no contact</td><td>s_rel &ge; s_rel0</td><td>f = 0</td></tr>
<tr><td>restraint still in tension</td><td>c_r*s_compressed &le; f_preload</td><td>f = -(c + c_r)*s_compressed</td></tr>
<tr><td>restraint released</td><td>c_r*s_compressed &gt; f_preload</td><td>f = -(f_preload + c*s_compressed)</td></tr>
</table>
<p>
The force is continuous. Each of its two kinks is one state event. Without preload the component is the spring of an
<a href=\"modelica://Modelica.Mechanics.Translational.Components.ElastoGap\">ElastoGap</a>.
</p>
<p>
It is <a href=\"modelica://PreloadedSprings.Springs.RestrainedPreloadedSpring\">RestrainedPreloadedSpring</a> on the
flanges of the Modelica Standard Library, with <code>k_s = c</code>, <code>k_h = c_r</code>,
<code>F_0 = f_preload</code>, <code>x_0 = -s_rel0</code>, <code>x = -s_rel</code>. There, <code>f</code> is positive
where the spring is compressed.
</p>
</html>"));
end PreloadedSpring;
