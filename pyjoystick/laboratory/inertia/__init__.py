"""Mass, center of mass and moment of inertia, from a swing test or from the parts (section 3.2)."""
