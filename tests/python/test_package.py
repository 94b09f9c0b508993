# SPDX-License-Identifier: GPL-3.0-or-later
"""The package itself: type stubs that agree with the module, installation as a component."""

import ast
import inspect
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import coagula
from support import ModuleTest

STUBS = Path(coagula.__file__).with_name("__init__.pyi")


class Stubs(ModuleTest):
    def setUp(self):
        super().setUp()
        self.nodes = {node.name: node for node in ast.parse(STUBS.read_text(encoding="utf-8")).body
                      if isinstance(node, (ast.FunctionDef, ast.ClassDef))}

    def test_names_are_those_of_the_module(self):
        public = set(coagula.__all__)
        self.assertEqual(public - set(self.nodes), set())
        for name in public:
            self.assertTrue(getattr(coagula, name).__doc__, name)
        self.assertTrue(STUBS.with_name("py.typed").exists())

    def test_arguments_are_those_of_the_functions(self):
        for name, node in self.nodes.items():
            if isinstance(node, ast.FunctionDef):
                arguments = [argument.arg for argument in [*node.args.args, *node.args.kwonlyargs]]
                parameters = inspect.signature(getattr(coagula, name)).parameters
                self.assertEqual(arguments, [one for one, what in parameters.items() if what.kind is not what.VAR_POSITIONAL])

    def test_attributes_are_those_of_the_values(self):
        made = self.made(particles=100, voids=50)
        for value in (made.packing, made.bonds):
            members = {node.name for node in self.nodes[type(value).__name__].body}
            public = {name for name in dir(value) if not name.startswith("_")}
            self.assertEqual(members & public, public)
            for name in public:
                self.assertTrue(getattr(type(value), name).__doc__, name)

    def test_every_option_of_the_program(self):
        for function, verb in ((coagula.generate_vem, "generate vem"), (coagula.generate_brownian, "generate brownian"),
                               (coagula.characterize, "characterize"), (coagula.shear, "shear"), (coagula.plot, "plot"),
                               (coagula.report, "report")):
            text = self.run_program(*verb.split(), "--help").stdout
            names = {name.replace("-", "_") for name in re.findall(r"^ +(?:-\w, )?--([\w-]+)", text, re.MULTILINE)}
            elsewhere = {"json", "quiet", "help", *(["threads"] if verb in ("plot", "report") else []), "output", "force", "potential_curve", "picture", "compare"}
            self.assertEqual(names - elsewhere - set(inspect.signature(function).parameters), set())

    @unittest.skipUnless(shutil.which("mypy", path="/usr/bin"), "mypy is not installed")
    def test_mypy_finds_mistakes_only(self):
        """One in each line of the second script after the first two."""
        (self.folder / "use.py").write_text("import coagula\nmade = coagula.generate_vem(volume_fraction=0.4, radius='1um')\n"
                                            "count: int = len(made.packing)\nvalue: float = made.packing.mean_radius\n"
                                            "response = coagula.shear(made)\nmodulus: float = response.storage_modulus.mean\n"
                                            "a: float = coagula.characterize(made).doh.a\nvoids: int = made.voids\n"
                                            "swept = coagula.shear(made, method='linear', frequency=[1.0, '10Hz'])\n"
                                            "print(swept.storage_modulus.mean[0])\n"
                                            "table = coagula.table(['a.h5', 'b.h5'])\n"
                                            "print(table.columns()['file'][0], table.volume_fraction.mean(), table.unit('radius_mean'))\n"
                                            "picture: str | None = coagula.plot('a.h5', figure='pore-curve').svg\n"
                                            "coagula.report(['a.h5'], 'page.html', overwrite=True)\n")
        lines = ["import coagula", "made = coagula.generate_vem(volume_fraction=0.4, radius='1um')", "coagula.shear(made, method='linar')",
                 "coagula.generate_vem(volume_fracton=0.4)", "coagula.characterize(0.4)", "name: str = made.packing.mean_radius",
                 "made.packing.positon", "coagula.plot('a.h5', figure='poer-curve')", "coagula.report('a.h5')",
                 "coagula.table('a.h5').columns()['file'] + coagula.table(3)", "modulus: str = coagula.shear(made).storage_modulus.mean"]
        (self.folder / "wrong.py").write_text("\n".join(lines) + "\n")
        done = subprocess.run(["/usr/bin/mypy", "--strict", "--cache-dir", "cache", "use.py", "wrong.py"], capture_output=True, text=True,
                              env={**os.environ, "MYPYPATH": str(STUBS.parents[1])})
        found = re.findall(r"^(\S+):(\d+): error", done.stdout, re.MULTILINE)
        self.assertEqual(set(found), {("wrong.py", str(line)) for line in range(3, len(lines) + 1)}, done.stdout)


class Installation(ModuleTest):
    def test_component(self):
        done = subprocess.run([os.environ["COAGULA_CMAKE"], "--install", os.environ["COAGULA_BUILD"], "--prefix", "prefix", "--component",
                               "python"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        place = next(Path("prefix").glob("lib/python3*/dist-packages")).resolve()
        done = subprocess.run([sys.executable, "-c", "import coagula; print(coagula.__file__, coagula.__version__)"],
                              env={**os.environ, "PYTHONPATH": str(place)}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        file, version = done.stdout.split(maxsplit=1)
        self.assertEqual(Path(file).parent, place / "coagula")
        self.assertIn(version.split()[0], self.run_program("--version").stdout)


if __name__ == "__main__":
    unittest.main()
