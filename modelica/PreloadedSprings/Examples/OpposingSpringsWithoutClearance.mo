within PreloadedSprings.Examples;
model OpposingSpringsWithoutClearance "Mass between two opposing restrained preloaded springs, without play"
  extends OpposingSprings(clearance = 0);

  annotation (
    experiment(StartTime = 0, StopTime = 1.5, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>With no clearance, one spring engages where the other lets go, and both events fall on the same instant.</p>
</html>"));
end OpposingSpringsWithoutClearance;
