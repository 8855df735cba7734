"""Whether a fit can be trusted, and what the model may lack where it cannot."""
