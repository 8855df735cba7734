"""A second reading of the model's source, which checks what rumoca made of modifiers."""
