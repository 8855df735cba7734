model LostSiblings "An extended class gives a value beside one that is modified two components deep"
  model Spring
    parameter Real k = 1;
    parameter Real x = 0; // here
    Real f = k*x;
  end Spring;
  model Assembly
    Spring spring;
  end Assembly;
  model Device
    Assembly assembly(spring(k = 5, x = 6));
  end Device;
  model Between
    extends Device;
  end Between;
  extends Between(assembly(spring(k = 9)));
end LostSiblings;
