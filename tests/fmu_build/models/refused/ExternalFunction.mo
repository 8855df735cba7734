model ExternalFunction "A function in C"
  function outside
    input Real x;
    output Real y;
    external "C" y = some_c_function(x); // here
  end outside;
  Real y;
equation
  y = outside(time);
end ExternalFunction;
