within PreloadedSprings.Springs;
model ActuatorAssembly "Return spring, and balance spring that engages later, side by side"
  extends PreloadedSprings.Interfaces.Compliant;
  PreloadedSprings.Springs.RestrainedPreloadedSpring returnSpring "Return spring, engaging after the clearance"
    annotation (Placement(transformation(extent = {{-20, 20}, {20, 60}})));
  PreloadedSprings.Springs.RestrainedPreloadedSpring balanceSpring
    "Balance spring, engaging when the rod bottoms out"
    annotation (Placement(transformation(extent = {{-20, -60}, {20, -20}})));
equation
  E = returnSpring.E + balanceSpring.E;
  connect(flange_a, returnSpring.flange_a);
  connect(flange_a, balanceSpring.flange_a);
  connect(returnSpring.flange_b, flange_b);
  connect(balanceSpring.flange_b, flange_b);
end ActuatorAssembly;
