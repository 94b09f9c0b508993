# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that describe the project to others name the version that CMake gives it."""

import json
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


class Version(unittest.TestCase):
    def test_is_the_same_everywhere(self):
        version = re.search(r"project\(coagula VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        self.assertEqual(re.search(r"(?m)^version: (.+)$", (ROOT / "CITATION.cff").read_text())[1], version)
        self.assertEqual(re.search(r'set version = "(.+)"', (ROOT / "packaging/conda/meta.yaml").read_text())[1], version)
        self.assertRegex((ROOT / "CHANGELOG.md").read_text(), rf"(?m)^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$")
        self.assertEqual(json.loads((ROOT / "codemeta.json").read_text())["version"], version)


if __name__ == "__main__":
    unittest.main()
