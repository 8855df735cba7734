"""A laboratory's own tables: their layout, headings and units are detected, or rejected if ambiguous."""
