"""Scripts of other programs, run after one changed import."""
