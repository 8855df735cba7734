within PreloadedSprings.UsersGuide;
class Conventions "Directions, units and names"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<ul>
<li>All values are in SI units, angles in rad. Angles are shown in degrees and travel in mm where the tool
converts units.</li>
<li>The angle <code>theta</code> is zero in the neutral position and positive forward.</li>
<li>The contact travel <code>x</code> of the joystick is positive for either direction (eq. 3).</li>
<li>The moments <code>M_s</code> of the contact and <code>M_d</code> of the damping stand on the left of eq. (1):
positive ones act against positive angles. <code>M_g</code> of the weight and the torque <code>T</code> stand on
the right: positive ones act towards positive angles. <code>M_stop</code> of a stop stands on the left,
<code>M_base</code> of an accelerated base on the right.</li>
<li>Springs are compressed where <code>flange_a</code> moves towards <code>flange_b</code>, that is where
<code>flange_a.s</code> exceeds <code>flange_b.s</code>. Their travel <code>x</code> counts from where both
positions are the same, their compression <code>delta</code> from the engagement <code>x_0</code>.</li>
<li>Names are those of the paper: <code>k_s</code>, <code>k_h</code>, <code>F_0</code>, <code>x_i</code>,
<code>k_i</code>, <code>a</code>, <code>b</code>, <code>h</code>, <code>J</code>, <code>C</code>. The number of
<code>x_0</code> to <code>x_3</code> in Table 1 is one less than the index of <code>x_i[:]</code>, since Modelica
counts from one.</li>
</ul>
</html>"));
end Conventions;
