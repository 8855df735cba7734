"""The paper's statements, each checked by a small function that computes numbers and decides by them."""
