"""Starts ``child``, which was loaded while it could still be read."""

import child  # type: ignore[import-not-found]  # stands beside it where it is started

child.main()
