"""Base parameters: which combinations of standard parameters the torques can tell apart, exactly and in symbols."""
