model OtherState "One of two bodies is stopped, and what the other does depends on which speeds are states"
  Real v_1(start=1, fixed=true), v_2;
  Real v_rel(start=0.2, fixed=true, stateSelect=StateSelect.prefer);
equation
  v_rel = v_2 - v_1;
  der(v_1) = v_rel;
  der(v_2) = -v_rel;
  when time >= 0.5 then
    reinit(v_1, 0);
  end when;
end OtherState;
