model FoldInBranch "A function that takes the least of several values beside nested branches"
  function f
    input Real u;
    output Real y;
  protected
    Real least = min(sin(if u > 0.5 then u else 2) for i in 1:3);
  algorithm
    y := 0.5;
    if least <= 1.8 then
      if y <= 0.7 then
        y := u + y;
      else
        least := 2*least;
      end if;
    end if;
    y := y + least;
  end f;
  Real x;
equation
  x = f(2*time); // here
end FoldInBranch;
