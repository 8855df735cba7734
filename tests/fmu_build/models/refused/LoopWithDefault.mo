model LoopWithDefault "A local of a function that a loop assigns, read before the loop"
  function f // here
    input Real x;
    output Real y;
  protected
    Real t = 10*x;
  algorithm
    y := t;
    for i in 1:5 loop
      t := y;
      y := t + 2*x;
    end for;
  end f;
  Real y = f(time);
end LoopWithDefault;
