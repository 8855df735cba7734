within PreloadedSprings.Damping;
model Constant "Constant damping coefficient"
  extends PreloadedSprings.Interfaces.DampingLaw;
  parameter PreloadedSprings.Units.RotationalDamping C = 0.045 "Damping coefficient";
equation
  coefficient = C;
initial equation
  assert(C >= 0, getInstanceName() + ".C must not be negative, but is " + String(C) + " N.m.s/rad");
end Constant;
