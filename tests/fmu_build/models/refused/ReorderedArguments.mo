package ReorderedArguments "Named arguments of a call with two results, in another order"
  function both
    input Real a;
    input Real b = 2;
    output Real y;
    output Real z;
  algorithm
    y := a - b;
    z := a + b;
  end both;

  function difference
    input Real u;
    output Real r;
  protected
    Real s;
  algorithm
    (r, s) := both(a=3, b=u);
    (r, s) := both(b=r, a=u); // here
  end difference;

  model Model
    Real y = difference(time);
  end Model;
end ReorderedArguments;
