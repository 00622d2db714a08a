"""The version of the generator, stated once; the package and every generated file quote it."""

VERSION = "0.1.0"
