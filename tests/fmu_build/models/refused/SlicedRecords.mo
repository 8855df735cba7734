model SlicedRecords "The last value of two of three records: the compiler would take those of one record"
  record Pair
    Real x[2];
  end Pair;
  parameter Pair pairs[3] = {Pair({1, 2}), Pair({3, 4}), Pair({5, 6})};
  Real y;
equation
  y = sum(pairs[2:3].x[2])*time; // here
end SlicedRecords;
