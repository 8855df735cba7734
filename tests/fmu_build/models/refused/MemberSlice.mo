model MemberSlice "The first value of each part: the compiler would take both values of the first part"
  model Part
    parameter Real k = 1;
    Real x[2];
  equation
    x = {k*time, 2*k*time};
  end Part;
  Part parts[2](k={1, 5});
  Real first[2];
equation
  first = parts.x[1]; // here
end MemberSlice;
