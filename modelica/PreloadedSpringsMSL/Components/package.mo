within PreloadedSpringsMSL;
package Components "Restrained preloaded springs and assemblies of them"
  extends Modelica.Icons.Package;

  annotation (Documentation(info = "<html>
<p>
Compliant components between two flanges of
<a href=\"modelica://Modelica.Mechanics.Translational\">Modelica.Mechanics.Translational</a>. All push only: where there
is no contact, there is no force.
</p>
</html>"));
end Components;
