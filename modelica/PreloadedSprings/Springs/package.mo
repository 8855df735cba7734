within PreloadedSprings;
package Springs "Restrained preloaded springs and assemblies of them"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-70, 0}, {-56, 0}, {-48, 34}, {-32, -34}, {-16, 34}, {0, -34}, {16, 34}, {32, -34}, {48, 34},
        {56, 0}, {70, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-56, 50}, {-56, -50}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{56, 50}, {56, -50}}, color = {64, 64, 64}, thickness = 0.5)}),
    Documentation(info = "<html>
<p>Section 3.1 of the paper. A <a href=\"modelica://PreloadedSprings.Springs.RestrainedPreloadedSpring\">restrained
preloaded spring</a> is the basic component. An
<a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">actuator assembly</a> is two of them; a
<a href=\"modelica://PreloadedSprings.Springs.TableAssembly\">table assembly</a> describes the same
load-deflection curve by its segments, as it comes out of a measurement.</p>
<p>All of them have two flanges and resist a motion of <code>flange_a</code> towards <code>flange_b</code>. They push
only: where there is no contact, there is no force.</p>
</html>"));
end Springs;
