within PreloadedSprings.Parts;
model Fixed "Flange that does not move"
  PreloadedSprings.Interfaces.TranslationalFlange flange "Fixed flange"
    annotation (Placement(transformation(extent = {{-10, -10}, {10, 10}})));
equation
  flange.s = 0;
end Fixed;
