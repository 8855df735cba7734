model ArraysNamedLikeInherited "What a component is given is lost because of an array in its base class"
  model Body
    parameter Real m = 1; // here
    Real weight = 9.81*m;
  end Body;
  model Load
    parameter Real m = 1;
  end Load;
  model Arm
    extends Body;
    Load loads[2](m={5, 7});
  end Arm;
  model LongArm
    extends Arm;
  end LongArm;
  LongArm arm(m=3);
end ArraysNamedLikeInherited;
