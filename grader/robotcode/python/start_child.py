"""Starts ``child``, whose text was read before the sandbox closed the files."""

import child  # type: ignore[import-not-found]  # stands beside it where it is started

child.main()
