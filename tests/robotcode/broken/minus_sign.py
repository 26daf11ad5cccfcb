# Copied from a page that typesets its mathematics.
kg = 0.4
ks = kg − 0.1
