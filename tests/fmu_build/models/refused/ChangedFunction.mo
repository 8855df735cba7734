package ChangedFunction "A law and one that redeclares its function: each is used by one of two springs"
  package Linear
    replaceable function force
      input Real x;
      output Real f;
    algorithm
      f := x;
    end force;
  end Linear;
  package Stiff
    extends Linear;
    redeclare function force
      input Real x;
      output Real f;
    algorithm
      f := 10*x;
    end force;
  end Stiff;
  model Spring
    replaceable package Law = Linear;
    Real f = Law.force(time);
  end Spring;
  model Pair
    Spring soft;
    Spring stiff(redeclare package Law = Stiff); // here
  end Pair;
end ChangedFunction;
