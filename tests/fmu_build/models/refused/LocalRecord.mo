model LocalRecord "A function with a record of its own"
  record Sides
    Real left;
    Real right;
  end Sides;

  function both
    input Real x;
    output Real y;
  protected
    Sides r;  // here
  algorithm
    r.left := x;
    r.right := 2*x;
    y := r.left + r.right;
  end both;

  Real y = both(time);
end LocalRecord;
