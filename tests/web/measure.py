#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Size, first paint and frames per second of pages of `coagula report` in headless Chromium: measure.py PAGE.html...

Graphics run in software here (SwiftShader), as on a machine without a graphics card: a lower bound. One view of 1280 x 720 pixels. While it
turns, the view lowers its resolution as far as its frames take long: frames per second as a reader sees them. At rest it is drawn whole: the
processor time of such a frame over all processes of the browser, which does not depend on what else the machine does."""

import os
import sys
import time
from pathlib import Path

from browser import Browser

FRAMES = """
const viewer = coagula.views.stages[0].viewer;
viewer.drawNow();
const start = performance.now();
let frames = 0;
while (performance.now() - start < 4000) {
  viewer.move({right: 0.05});
  viewer.drawNow();
  ++frames;
}
return frames;
"""

TURNING = """
const done = arguments[arguments.length - 1];
const viewer = coagula.views.stages[0].viewer;
const start = performance.now();
let frames = 0;
function next() {
  viewer.move({right: 0.02});
  ++frames;
  performance.now() - start < 5000 ? requestAnimationFrame(next) : done(1000 * frames / (performance.now() - start));
}
requestAnimationFrame(next);
"""

SETTINGS = {"spheres": "{}", "bonds by force": "{bonds: 'normal_force', sphereScale: 0.35}"}


def processor_time(parent):
    """Seconds of a process and all that descend from it."""
    children, times = {}, {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parts = (folder / "stat").read_text().rsplit(") ", 1)[1].split()
        except OSError:
            continue
        children.setdefault(int(parts[1]), []).append(int(folder.name))
        times[int(folder.name)] = (int(parts[11]) + int(parts[12])) / os.sysconf("SC_CLK_TCK")
    found, stack = 0.0, [parent]
    while stack:
        process = stack.pop()
        found += times.get(process, 0)
        stack += children.get(process, [])
    return found


def main():
    print("page                      size [MB]  first paint [s]  ready [s]  " + "  ".join(f"{name}: turning [frames/s]  at rest [s of processor]" for name in SETTINGS))
    for path in map(Path, sys.argv[1:]):
        with Browser(1700, 900) as browser:
            browser.open(path)
            paint = browser.run("return performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN")
            ready = browser.run("return coagula.ready")
            browser.run("document.querySelector('.stage').style.cssText = 'position: fixed; inset: 0 auto auto 0; width: 1280px; z-index: 9'; "
                        "document.querySelector('.canvas').style.height = '720px'")
            time.sleep(1)
            rates = []
            for settings in SETTINGS.values():
                browser.run(f"coagula.views.change({settings})")
                time.sleep(0.5)
                before = processor_time(browser.driver.service.process.pid)
                frames = browser.run(FRAMES)
                spent = processor_time(browser.driver.service.process.pid) - before
                rates.append((browser.driver.execute_async_script(TURNING), spent / frames))
            print(f"{path.name:24}  {path.stat().st_size / 1e6:9.2f}  {paint / 1000:15.2f}  {ready / 1000:9.2f}  "
                  + "  ".join(f"{rate:{len(name) + 20}.1f}  {spent:24.3f}" for name, (rate, spent) in zip(SETTINGS, rates)))


if __name__ == "__main__":
    main()
