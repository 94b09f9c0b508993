#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases of test modules, one module.Class.method a line, without importing them: list_cases.py MODULE.py..."""

import ast
import sys
from pathlib import Path

for path in map(Path, sys.argv[1:]):
    for node in ast.parse(path.read_text(), str(path)).body:
        if isinstance(node, ast.ClassDef):
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and item.name.startswith("test_"):
                    print(f"{path.stem}.{node.name}.{item.name}")
