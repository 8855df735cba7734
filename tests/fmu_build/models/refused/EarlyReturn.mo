model EarlyReturn "A return inside a loop"
  function first_above
    input Real a[:];
    input Real level;
    output Integer k;
  algorithm
    k := 0;
    for i in 1:size(a, 1) loop
      if a[i] > level then
        k := i;
        return; // here
      end if;
    end for;
  end first_above;
  Real y;
equation
  y = first_above({1, 2, 3}, time);
end EarlyReturn;
