model LeakingModifier "What is given to gain would also be given to inside.gain"
  block Gain
    parameter Real k = 1; // here
    output Real y = k;
  end Gain;
  block Inner
    Gain gain;
  end Inner;
  block Outer
    Gain gain(k=2);
    Inner inside(gain(k=3));
  end Outer;
  Outer outer1(gain(k=7));
end LeakingModifier;
