"""Files: laser logs in, maps out."""
