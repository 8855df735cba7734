"""Which experiment determines the parameters best."""
