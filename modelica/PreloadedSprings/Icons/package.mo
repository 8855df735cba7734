within PreloadedSprings;
package Icons "Icons that several classes share"
  extends PreloadedSprings.Icons.Package;

  annotation (Documentation(info = "<html>
<p>Partial classes that hold a picture and nothing else.</p>
</html>"));
end Icons;
