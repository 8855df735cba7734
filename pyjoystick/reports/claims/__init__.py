"""The paper's claims, each checked by a small function that computes numbers and decides by them."""
