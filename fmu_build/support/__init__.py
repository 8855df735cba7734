"""What every room uses: errors, the description of a model, what is asked of a build and what comes of it."""
