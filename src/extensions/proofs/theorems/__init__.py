"""The theorems with their certificates, proofs on request, and data for the pictures of proofs."""
