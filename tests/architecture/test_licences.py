# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source names its licence where tools that collect licences look for it."""

import os
import unittest
from pathlib import Path

SOURCE = Path(os.environ.get("COAGULA_SOURCE", Path(__file__).parents[2]))
LINE = "SPDX-License-Identifier: GPL-3.0-or-later"
ENDINGS = {".cpp", ".hpp", ".py", ".cmake", ".ts", ".css"}
FOLDERS = ["characterize", "cmake", "common", "diagnose", "examples", "experiment", "generators", "mechanics", "packaging", "python", "report", "scripts", "stages",
           "tests", "tools", "web/src"]


def sources():
    for folder in FOLDERS:
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.is_file() and "node_modules" not in path.parts and (path.suffix in ENDINGS or path.name == "CMakeLists.txt" or is_script(path)):
                yield path


def is_script(path):
    """Whether a file without an ending begins as a script does."""
    if path.suffix or not os.access(path, os.X_OK):
        return False
    with open(path, "rb") as file:
        return file.read(2) == b"#!"


class Licences(unittest.TestCase):
    def test_each_source_names_its_licence(self):
        found = list(sources())
        self.assertGreater(len(found), 1000)
        without = [str(path.relative_to(SOURCE)) for path in found if not any(LINE in line for line in path.read_text().splitlines()[:3])]
        self.assertEqual(without, [], "these sources lack the line " + LINE)


if __name__ == "__main__":
    unittest.main()
