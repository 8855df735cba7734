within PreloadedSpringsMSL;
package Examples "Models that can be simulated as they are"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info = "<html>
<p>
Each example is complete and includes its simulation settings; its documentation says what to plot. The variables to
compare between tools are listed in <code>Resources/Reference/PreloadedSpringsMSL/Examples/</code>, in
<code>comparisonSignals.txt</code> of each example.
</p>
</html>"));
end Examples;
