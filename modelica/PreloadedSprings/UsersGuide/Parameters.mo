within PreloadedSprings.UsersGuide;
class Parameters "The paper's values, and what is refused"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<p>Table 1 gives the load-deflection curves of the two actuators; the springs' data follow from them as
<a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">ActuatorAssembly</a> says.</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th></th><th>x_i in mm</th><th>k_i in N/m</th><th>return spring: k_s, k_h in N/m; F_0 in N</th>
<th>balance spring: k_s, k_h in N/m; F_0 in N</th></tr>
<tr><td>forward</td><td>0.075, 0.1985, 2.932, 2.943</td><td>430000, 2625, 1028000, 5600</td>
<td>2625, 427375; 52.7808125</td><td>2975, 1022400; 11.2464</td></tr>
<tr><td>backward</td><td>0.075, 0.1595, 3.054, 3.063</td><td>659000, 1191, 1112000, 4090</td>
<td>1191, 657809; 55.5848605</td><td>2899, 1107910; 9.97119</td></tr>
</table>
<p>Table 2 gives the handle: <code>m</code> = 0.87 kg, <code>J</code> = 0.01135 kg.m2, <code>h</code> = 82 mm,
<code>a</code> = 23.98 mm, <code>b</code> = 5.0 mm. The acceleration of gravity is not in the paper.</p>
<p>Impossible parameter values are rejected at the start of a simulation, with a message that names the component, the
parameter and its value: stiffnesses, <code>J</code>, <code>m</code> and <code>a</code> that are not positive;
preloads, clearances, distances, damping coefficients, friction and <code>g</code> that are negative; a balance
spring that engages before the return spring; table travels that do not increase; a start angle or stops
at 90 degrees or more; a weight <code>alpha</code> that is not between 0 and 1; smoothings that are not positive; a
static friction below the Coulomb friction.</p>
</html>"));
end Parameters;
