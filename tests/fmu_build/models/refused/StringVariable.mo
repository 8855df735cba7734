model StringVariable "A variable of type String"
  String s; // here
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  s = if x > 0.5 then "big" else "small";
end StringVariable;
