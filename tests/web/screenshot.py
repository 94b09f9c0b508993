#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a page as it opens, for the documentation: screenshot.py PAGE.html PICTURE.png [WIDTH HEIGHT]"""

import base64
import sys
import time
from pathlib import Path

from browser import Browser


def main():
    page, picture = sys.argv[1:3]
    width, height = map(int, sys.argv[3:5]) if len(sys.argv) > 4 else (1500, 1000)
    with Browser(width, height) as browser:
        browser.set_width(width, height)
        browser.open(page)
        time.sleep(2)
        data = browser.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
        Path(picture).write_bytes(base64.b64decode(data))


if __name__ == "__main__":
    main()
