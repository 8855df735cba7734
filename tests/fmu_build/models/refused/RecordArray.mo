model RecordArray "Derivatives of the members of records in an array"
  record Pair
    Real a;
    Real b;
  end Pair;
  Pair r[3](a(each start=0, each fixed=true));
equation
  for i in 1:3 loop
    der(r[i].a) = i - r[i].b; // here
    r[i].b = 2*r[i].a;
  end for;
end RecordArray;
