# SPDX-License-Identifier: GPL-3.0-or-later
"""Version and git revision."""

from ._coagula import version as _version

version = _version()
