model InputLimit "The left limit of a variable that follows an input"
  input Real u;
  Real y = 2*u;
  discrete Real d(start=0, fixed=true);
equation
  when sample(0, 0.1) then
    d = pre(y);
  end when;
end InputLimit;
