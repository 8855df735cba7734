model SequentialAlgorithm "An algorithm that reads what it has assigned, and assigns it again"
  Real x(start=0, fixed=true);
  Real y, z;
equation
  der(x) = 1;
algorithm
  y := x;
  if y > 0.5 then
    y := 2*y; // here
  end if;
  z := y;
end SequentialAlgorithm;
