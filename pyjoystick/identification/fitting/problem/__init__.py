"""The least-squares problem: records, predictions by the FMU, weights, and free variables."""
