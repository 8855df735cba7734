"""JSON schemas of the TOML files."""
