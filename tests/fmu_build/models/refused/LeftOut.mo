model LeftOut "The first of three results is not wanted"
  function powers
    input Real x;
    output Real one;
    output Real two;
    output Real three;
  algorithm
    one := x;
    two := x*x;
    three := x*x*x;
  end powers;
  Real b, c;
equation
  (, b, c) = powers(time); // here
end LeftOut;
