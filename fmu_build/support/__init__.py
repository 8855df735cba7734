"""What every room uses: errors, the description of a model, requests and results of builds."""
