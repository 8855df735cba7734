package PreloadedSprings "Dynamics of mechanical systems with opposing restrained preloaded springs"
  extends PreloadedSprings.Icons.Package;

  annotation (version = "1.0.0", uses());
end PreloadedSprings;
