"""Laws of force against length."""
