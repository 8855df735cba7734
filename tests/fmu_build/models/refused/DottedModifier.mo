model DottedModifier "A modifier that names what is inside a component with a dot"
  model Rate
    parameter Real rate = 1;
    Real y(start = 0, fixed = true);
  equation
    der(y) = rate;
  end Rate;

  model Pair
    Rate one, other;
  end Pair;

  Pair pair(one(y(start = sin(0.1))), other.rate = 0.5); // here
end DottedModifier;
