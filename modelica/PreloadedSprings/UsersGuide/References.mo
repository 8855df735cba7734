within PreloadedSprings.UsersGuide;
class References "References"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<p>R. J. Rogers, P. Garland, M. Oliver: <em>Dynamic modelling of mechanical systems with opposing restrained
preloaded stiffnesses</em>. Journal of Sound and Vibration 274 (2004) 73-89.</p>
<p>The library departs from the paper in three places:</p>
<ul>
<li>Eq. (5) is corrected, as <a href=\"modelica://PreloadedSprings.Joystick.CamPlate\">CamPlate</a> explains.</li>
<li>Eq. (11) is smoothed where it is infinite, as
<a href=\"modelica://PreloadedSprings.Damping.PowerLaw\">PowerLaw</a> explains.</li>
<li>The actuators are modeled by their springs; the paper's table of segments is the alternative.</li>
</ul>
</html>"));
end References;
