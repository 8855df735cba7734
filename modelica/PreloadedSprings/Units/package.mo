within PreloadedSprings;
package Units "Physical quantities with their units and display units"
  extends Icons.Package;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{-80, 60}, {80, -60}}, textString = "SI", textColor = {64, 64, 64})}),
    Documentation(info = "<html>
<p>Every parameter and variable of the library is declared with one of these types. Values are in SI
units throughout; the display unit is what a tool shows, such as degrees for angles and millimeters
for travel. Quantity names are those of the Modelica Standard Library.</p>
</html>"));
end Units;
