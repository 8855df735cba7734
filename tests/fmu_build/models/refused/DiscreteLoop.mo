model DiscreteLoop "Integers that are given in a loop"
  Real x(start=0, fixed=true);
  Integer level[3]; // here
equation
  der(x) = 1;
  for i in 1:3 loop
    level[i] = if x > 0.2*i then i else 0;
  end for;
end DiscreteLoop;
