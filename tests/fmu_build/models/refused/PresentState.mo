model PresentState "The condition of a when-clause reads the state that the clause sets"
  type State = enumeration(idle, running);
  Real x(start=0, fixed=true);
  State state(start=State.idle, fixed=true);
equation
  der(x) = 1;
  when state == State.idle and x > 0.5 then
    state = State.running; // here
  end when;
end PresentState;
