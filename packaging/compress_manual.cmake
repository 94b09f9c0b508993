# SPDX-License-Identifier: GPL-3.0-or-later
# Run by CPack before it packs: Debian's manual pages are compressed, without a date.
file(GLOB_RECURSE pages "${CPACK_TEMPORARY_DIRECTORY}/*.1")
if(pages)
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()
