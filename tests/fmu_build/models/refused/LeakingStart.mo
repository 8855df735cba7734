model LeakingStart "The temperature of the body would also be that of the rod in it"
  model Rod
    Real T(start=1, fixed=true); // here
  equation
    der(T) = 0;
  end Rod;
  model Body
    Rod rod(T(start=300));
    Real T(start=5, fixed=true);
  equation
    der(T) = 0;
  end Body;
  model Room
    Body body;
  end Room;
  extends Room(body(T(start=400)));
end LeakingStart;
