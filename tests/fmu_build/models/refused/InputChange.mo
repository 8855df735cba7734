model InputChange "change() of a continuous input"
  input Real u;
  discrete Real y(start=0, fixed=true);
equation
  when change(u) then // here
    y = u;
  end when;
end InputChange;
