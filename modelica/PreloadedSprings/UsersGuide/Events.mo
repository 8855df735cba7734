within PreloadedSprings.UsersGuide;
class Events "Kinks and state events"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<p>The force of a restrained preloaded spring has two kinks, and an integrator that steps over a kink loses its
order. Every kink is therefore the change of a relation that Modelica turns into a state event: the
simulator finds its time, stops there and goes on with the other branch.</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th>Component</th><th>Events</th></tr>
<tr><td>restrained preloaded spring</td><td>2: contact (<code>isEngaged</code>), restraint released
(<code>isReleased</code>)</td></tr>
<tr><td>actuator assembly</td><td>4: those of its two springs</td></tr>
<tr><td>table assembly</td><td>one for each segment (<code>isReached</code>)</td></tr>
<tr><td>cam plate</td><td>1: sign of the angle (<code>isForward</code>)</td></tr>
<tr><td>joystick</td><td>9: those of two actuators and of the cam plate</td></tr>
<tr><td>dry friction</td><td>4: slides either way (<code>mode</code> 1, -1), pushed off either way</td></tr>
<tr><td>stops</td><td>2: met (<code>isMet</code>), pushing (<code>isPushing</code>)</td></tr>
</table>
<p>Each relation is written once. Forces, energies and damping read the truth values, which keep their value
between events. Every branch holds beyond the end of its segment, so an integrator may look ahead.</p>
<p>Without clearance, the contacts of both sides and the sign of the angle change at the same time.</p>
</html>"));
end Events;
