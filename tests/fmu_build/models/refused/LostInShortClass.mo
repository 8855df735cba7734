model LostInShortClass "The same in a short class definition, and with attributes of a variable"
  model Body
    Real v(start = 1, fixed = true); // here
  equation
    der(v) = 0;
  end Body;
  model Train
    Body body[2](v(each start = 2, each nominal = 5));
  end Train;
  model Faster=Train( // a comment with (
    body(v(each start = 3 "and a ) text")));
  Faster train;
end LostInShortClass;
