model ArraysInExtends "What d is given for its own p is lost"
  model S
    parameter Real p = 1;
  end S;
  model Pair
    S s[2];
  end Pair;
  model D
    extends Pair(s(p={8, 9}));
    parameter Real p = 3; // here
  end D;
  D d(p=7);
end ArraysInExtends;
