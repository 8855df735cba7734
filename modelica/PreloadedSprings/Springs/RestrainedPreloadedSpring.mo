within PreloadedSprings.Springs;
model RestrainedPreloadedSpring "Spring that a restraint keeps compressed until a force exceeds the preload"
  extends PreloadedSprings.Interfaces.ForceElement;
  parameter PreloadedSprings.Units.Stiffness k_s(start = 2625) "Stiffness of the spring";
  parameter PreloadedSprings.Units.Stiffness k_h(start = 427375) "Stiffness of the restraint";
  parameter PreloadedSprings.Units.Force F_0(min = 0, start = 52.78) "Preload of the spring";
  parameter PreloadedSprings.Units.Length x_0 = 0 "Travel at which the spring engages";
  PreloadedSprings.Units.Position delta "Compression from the preloaded position";
  Boolean isEngaged "True where the spring is in contact";
  Boolean isReleased "True where the restraint carries no force";
equation
  delta = x - x_0;
  isEngaged = x > x_0;
  isReleased = k_h*delta > F_0;
  f = if isReleased then F_0 + k_s*delta elseif isEngaged then (k_h + k_s)*delta else 0;
  E = if isReleased then F_0*(delta - F_0/(2*k_h)) + k_s*delta^2/2
    elseif isEngaged then (k_h + k_s)*delta^2/2 else 0;
initial equation
  assert(k_s > 0, getInstanceName() + ".k_s must be positive, but is " + String(k_s) + " N/m");
  assert(k_h > 0, getInstanceName() + ".k_h must be positive, but is " + String(k_h) + " N/m");
  assert(F_0 >= 0, getInstanceName() + ".F_0 must not be negative, but is " + String(F_0) + " N");
  assert(x_0 >= 0, getInstanceName() + ".x_0 must not be negative, but is " + String(x_0) + " m");
end RestrainedPreloadedSpring;
