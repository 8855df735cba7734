within PreloadedSprings;
package UsersGuide "User's Guide"
  extends Icons.Information;

  annotation (
    DocumentationClass = true,
    Documentation(info = "<html>
<p>What the library is for, how its components fit together, and the rules that all of them follow.</p>
<ol>
<li><a href=\"modelica://PreloadedSprings.UsersGuide.Overview\">Overview</a>: the packages, and which model to
use for what</li>
<li><a href=\"modelica://PreloadedSprings.UsersGuide.Conventions\">Conventions</a>: directions, units, names</li>
<li><a href=\"modelica://PreloadedSprings.UsersGuide.Events\">Events</a>: where the models have kinks, and what a
simulator does there</li>
<li><a href=\"modelica://PreloadedSprings.UsersGuide.Parameters\">Parameters</a>: the paper's values, and what is
refused</li>
<li><a href=\"modelica://PreloadedSprings.UsersGuide.References\">References</a></li>
</ol>
</html>"));
end UsersGuide;
