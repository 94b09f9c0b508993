# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium with a page of coagula, and what the tests of pages share."""

import shutil
import time
import unittest
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

CLOSED = ["--headless=new", "--no-sandbox", "--disable-background-networking", "--disable-component-update", "--no-first-run",
          "--disable-default-apps", "--hide-scrollbars"]
SOFTWARE_GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def why_no_browser():
    """A sentence, or None."""
    if webdriver is None:
        return "python3-selenium is not installed"
    for program in ("chromium", "chromedriver"):
        if shutil.which(program) is None:
            return f"{program} is not installed"
    return None


class Browser:
    """Opens pages from the file system; everything the console says is kept."""

    def __init__(self, width=1400, height=1000, graphics=SOFTWARE_GRAPHICS, downloads=None):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for word in CLOSED + graphics + [f"--window-size={width},{height}"]:
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        if downloads:
            self.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(downloads)})

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.driver.quit()

    def open(self, path, ready="return 'ready' in document.documentElement.dataset"):
        self.driver.get(Path(path).resolve().as_uri())
        self.wait_for(ready)

    def run(self, script, *words):
        return self.driver.execute_script(script, *words)

    def wait_for(self, script, *words, seconds=60):
        end = time.monotonic() + seconds
        while not self.run(script, *words):
            if time.monotonic() > end:
                raise AssertionError(f"'{script}' did not come true; the console says {self.console()}")
            time.sleep(0.05)

    def console(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def set_width(self, width, height=1000):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def prefer(self, scheme):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def find_all(self, selector):
        return self.driver.find_elements("css selector", selector)

    def click_at(self, element, x, y):
        """x and y in pixels from the upper left corner of the element."""
        box = element.rect
        webdriver.ActionChains(self.driver).move_to_element_with_offset(element, x - box["width"] // 2, y - box["height"] // 2).click().perform()

    def drag(self, element, dx, dy):
        webdriver.ActionChains(self.driver).move_to_element(element).click_and_hold().move_by_offset(dx, dy).release().perform()

    def press(self, element, *keys):
        element.send_keys(*keys)

    def download(self, button, folder, name):
        """The text of the file that a button gives."""
        path = Path(folder) / name
        self.run("arguments[0].scrollIntoView({block: 'center'})", button)
        button.click()
        end = time.monotonic() + 20
        while not path.exists() or path.with_name(name + ".crdownload").exists():
            if time.monotonic() > end:
                raise AssertionError(f"{name} was not downloaded; there are {sorted(p.name for p in Path(folder).iterdir())}")
            time.sleep(0.05)
        return path.read_text(encoding="utf-8")


needs_browser = unittest.skipIf(why_no_browser(), why_no_browser() or "")
