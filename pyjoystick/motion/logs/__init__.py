"""A laboratory's own tables: their form, their headings and their units, found out or refused."""
