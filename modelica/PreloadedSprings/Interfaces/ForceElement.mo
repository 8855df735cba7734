within PreloadedSprings.Interfaces;
partial model ForceElement "Massless element with one force"
  extends Compliant;
equation
  flange_a.f + flange_b.f = 0;

  annotation (Documentation(info = "<html>
<p>The force that enters at one flange leaves at the other. An extending class gives <code>f</code> and
<code>E</code>.</p>
</html>"));
end ForceElement;
