model Transport "spatialDistribution"
  Real y;
  Real z;
equation
  (y, z) = spatialDistribution(time, 0, time, true, {0, 1}, {0, 0}); // here
end Transport;
