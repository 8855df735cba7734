"""JSON schema of the documents that commands write."""
