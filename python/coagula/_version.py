"""Version and git revision."""

from ._coagula import version as _version

version = _version()
