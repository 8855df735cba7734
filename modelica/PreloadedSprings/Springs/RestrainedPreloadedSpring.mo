within PreloadedSprings.Springs;
model RestrainedPreloadedSpring "Spring that a restraint keeps compressed until a force exceeds the preload"
  extends Interfaces.ForceElement;
  parameter Units.Stiffness k_s(start = 2625) "Stiffness of the spring";
  parameter Units.Stiffness k_h(start = 427375) "Stiffness of the restraint (rod or housing)";
  parameter Units.Force F_0(min = 0, start = 52.7808125) "Preload";
  parameter Units.Length x_0 = 0 "Travel at which the spring engages";
  Units.Position delta "Compression from the preloaded position";
  Boolean isEngaged "True where there is contact";
  Boolean isReleased "True where the restraint carries no force any more";
equation
  delta = x - x_0;
  isEngaged = x > x_0;
  isReleased = k_h*delta > F_0;
  f = if isReleased then F_0 + k_s*delta elseif isEngaged then (k_h + k_s)*delta else 0;
  E = if isReleased then F_0*(delta - F_0/(2*k_h)) + k_s*delta^2/2
    elseif isEngaged then (k_h + k_s)*delta^2/2 else 0;
initial equation
  assert(k_s > 0, getInstanceName() + ".k_s must be positive, but is " + String(k_s) + " N/m");
  assert(k_h > 0, getInstanceName() + ".k_h must be positive, but is " + String(k_h) + " N/m");
  assert(F_0 >= 0, getInstanceName() + ".F_0 must not be negative, but is " + String(F_0) + " N");
  assert(x_0 >= 0, getInstanceName() + ".x_0 must not be negative, but is " + String(x_0) + " m");

  annotation (
    defaultComponentName = "spring",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{-90, 0}, {-84, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-84, 26}, {-84, -26}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-64, 0}, {64, 0}}, color = {128, 128, 128}, thickness = 0.5),
      Rectangle(extent = {{-74, 10}, {-62, -10}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-62, 46}, {-62, -46}}, color = {64, 64, 64}, thickness = 0.75),
      Line(points = {{62, 46}, {62, -46}}, color = {64, 64, 64}, thickness = 0.75),
      Line(points = {{-62, 0}, {-54, 34}, {-38, -34}, {-22, 34}, {-6, -34}, {10, 34}, {26, -34}, {42, 34}, {54, -34},
        {62, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{62, 0}, {90, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Text(extent = {{-150, -60}, {150, -90}}, textColor = {0, 0, 0}, textString = "F_0 = %F_0")}),
    Documentation(info = "<html>
<p>A helical spring of stiffness <code>k_s</code> that is held compressed with the force <code>F_0</code> by a
restraint of stiffness <code>k_h</code>: a central rod, or the housing around it (Figs. 1 and 8 of the paper).
With the compression <code>delta = x - x_0</code> from the preloaded position, the force is</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th>State</th><th>Condition</th><th>Force</th><th>Equation</th></tr>
<tr><td>no contact</td><td>delta &le; 0</td><td>f = 0</td><td></td></tr>
<tr><td>restraint still in tension</td><td>k_h*delta &le; F_0</td><td>f = (k_h + k_s)*delta</td><td>(7)</td></tr>
<tr><td>restraint released</td><td>k_h*delta &gt; F_0</td><td>f = F_0 + k_s*delta</td><td>(8)</td></tr>
</table>
<p>Eq. (7) follows from the equilibrium of eq. (6): the spring's force <code>F_0 + k_s*delta</code> equals
<code>f</code> plus the restraint's tension <code>F_0 - k_h*delta</code>. The paper writes eq. (8) with the
spring's initial compression <code>x_so = F_0/k_s</code>. The force is continuous. Each of its two
kinks is one state event.</p>
<p>The energy <code>E</code> is the work done from the preloaded position.</p>
<p>Positive stiffnesses, a preload and an engagement <code>x_0</code> that are not negative are required;
other values stop the simulation at its start with a message that names the parameter.</p>
</html>"));
end RestrainedPreloadedSpring;
