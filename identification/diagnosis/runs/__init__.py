"""One run as the diagnosis sees it: beside the model, in rows, with the drive trains that its log has."""
