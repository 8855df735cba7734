"""What is minimized: records, predictions by the FMU, weights, and the free numbers."""
