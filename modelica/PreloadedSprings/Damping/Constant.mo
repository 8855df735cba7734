within PreloadedSprings.Damping;
model Constant "Constant damping coefficient"
  extends Interfaces.DampingLaw;
  parameter Units.RotationalDamping C = 0.045 "Damping coefficient";
equation
  coefficient = C;
initial equation
  assert(C >= 0, getInstanceName() + ".C must not be negative, but is " + String(C) + " N.m.s/rad");

  annotation (
    defaultComponentName = "damping",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Text(extent = {{10, 30}, {76, -30}}, textColor = {64, 64, 64}, textString = "C")}),
    Documentation(info = "<html>
<p>A constant coefficient of eq. (1). The paper finds that 0.045 N.m.s/rad reproduces the times of its measured peaks
best.</p>
</html>"));
end Constant;
