package PreloadedSprings "Dynamics of mechanical systems with opposing restrained preloaded springs"
  extends PreloadedSprings.Icons.Package;

  annotation (
    preferredView = "info",
    version = "1.0.0",
    versionDate = "2026-11-23",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-22, 26}, {22, -26}}, lineColor = {0, 127, 0}, fillColor = {160, 205, 160},
        fillPattern = FillPattern.Solid),
      Line(points = {{-84, 40}, {-84, -40}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{84, 40}, {84, -40}}, color = {64, 64, 64}, thickness = 1),
      Line(points = {{-84, 0}, {-76, 22}, {-66, -22}, {-56, 22}, {-46, -22}, {-36, 22}, {-32, 0}}, color = {0, 127, 0},
        thickness = 0.5),
      Line(points = {{84, 0}, {76, 22}, {66, -22}, {56, 22}, {46, -22}, {36, 22}, {32, 0}}, color = {0, 127, 0},
        thickness = 0.5),
      Line(points = {{-32, 30}, {-32, -30}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{32, 30}, {32, -30}}, color = {64, 64, 64}, thickness = 0.5)}),
    Documentation(info = "<html>
<p>Models of systems in which a body moves between springs that are preloaded against restraints, and of the
joystick of hydraulic valves that led to their study. Near the middle, the force of such springs changes almost at
once from one preload to the opposite one, so the period of a free oscillation falls as its amplitude falls.</p>
<p>The models follow R. J. Rogers, P. Garland and M. Oliver, <em>Dynamic modelling of mechanical systems with
opposing restrained preloaded stiffnesses</em>, Journal of Sound and Vibration 274 (2004) 73-89. Equation, figure
and table numbers are those of that paper.</p>
<p>Begin with the <a href=\"modelica://PreloadedSprings.UsersGuide\">User's Guide</a> and the
<a href=\"modelica://PreloadedSprings.Examples\">examples</a>. The library needs no other library.</p>
</html>"));
end PreloadedSprings;
