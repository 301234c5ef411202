// Something for a module to be made of.
