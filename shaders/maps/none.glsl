// maps=none.
