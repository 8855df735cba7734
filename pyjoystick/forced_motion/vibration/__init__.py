"""What a handle does on a base that shakes, alone and in a hand."""
