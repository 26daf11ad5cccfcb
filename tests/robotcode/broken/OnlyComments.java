// TODO: everything

/* nothing yet */
