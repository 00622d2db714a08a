"""One measured study a module, found by discovery: ``TITLE`` and ``run(build)``."""
