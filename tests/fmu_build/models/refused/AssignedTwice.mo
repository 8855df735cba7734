model AssignedTwice "A discrete Real that one when-clause of an algorithm assigns twice"
  Real x(start=0, fixed=true);
  discrete Real k(start=0, fixed=true);
equation
  der(x) = 1;
algorithm
  when sample(0.1, 0.1) then
    k := x;
    if x > 0.35 then
      k := 100 + x; // here
    end if;
  end when;
end AssignedTwice;
