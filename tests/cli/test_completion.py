# SPDX-License-Identifier: GPL-3.0-or-later
"""Completion in a real bash and a real zsh, and manual pages that troff reads without a warning: all from the tables of options."""

import os
import pty
import re
import select
import shutil
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest
from test_usage import VERBS


def options_of(text):
    return re.findall(r"^  (?:-\w, |    )(--[a-z0-9-]+)", text, re.MULTILINE)


class Bash(ProgramTest):
    def complete(self, line):
        """What bash offers for the last word of the line, which its words and '=' take apart as readline does."""
        words = [word for word in re.split(r" |(=)", line) if word is not None and (word != "" or line.endswith(" "))]
        quoted = " ".join(f"'{word}'" for word in words)
        script = (f"source <('{PROGRAM}' completion bash); COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _coagula; "
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "--norc", "-c", script], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return sorted(set(done.stdout.split("\n")) - {""})

    def test_verbs(self):
        self.assertEqual(self.complete("coagula sh"), ["shear"])
        self.assertEqual(self.complete("coagula generate "), ["brownian", "vem"])
        self.assertEqual(self.complete("coagula fit "), ["power-law"])
        self.assertEqual(set(self.complete("coagula ")), {verb.split()[0] for verb in VERBS} | {"generate", "--help", "--version"})

    def test_every_option_of_every_verb(self):
        for verb in [*VERBS, "generate brownian"]:
            listed = options_of(self.succeed(*verb.split(), "--help"))
            self.assertGreaterEqual(len(listed), 4)
            self.assertEqual(self.complete(f"coagula {verb} --"), sorted(listed))

    def test_values(self):
        self.assertEqual(self.complete("coagula shear --method d"), ["dem"])
        self.assertEqual(self.complete("coagula shear --method=d"), ["dem"])
        self.assertEqual(self.complete("coagula shear --method="), ["dem", "linear", "quasistatic"])
        self.assertEqual(self.complete("coagula completion "), ["bash", "zsh"])
        self.assertEqual(self.complete("coagula shear --normal-stiffness "), [])

    def test_files(self):
        for name in ("a.h5", "b c.h5", "model.toml", "points.csv"):
            self.write(name, "")
        (self.folder / "runs").mkdir()
        self.assertEqual(self.complete("coagula shear "), ["a.h5", "b c.h5", "runs"])
        self.assertEqual(self.complete("coagula shear a.h5 --model "), ["model.toml", "runs"])
        self.assertEqual(self.complete("coagula import p"), ["points.csv"])
        self.assertEqual(self.complete("coagula man -o r"), ["runs"])


class Terminal(ProgramTest):
    """The shells as people use them: keys go in, the completed line is echoed."""

    def type(self, shell, setup, *lines):
        """@param lines: keys, and what is to be seen after them."""
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.folder)
            environment = {"PATH": os.environ["PATH"], "TERM": "dumb", "PS1": "ready> ", "HOME": str(self.folder)}
            os.execvpe(shell[0], shell, environment)
        try:
            self.echo(terminal, setup + "; echo set'' ''up\n", "set up")
            for keys, expected in lines:
                echoed = self.echo(terminal, keys, expected)
                self.assertIn(expected, echoed)
                os.write(terminal, b"\x15")  # Ctrl-U empties the line
        finally:
            os.close(terminal)
            os.waitpid(child, 0)

    def echo(self, terminal, keys, expected):
        os.write(terminal, keys.encode())
        text, end = "", time.monotonic() + 20
        while time.monotonic() < end and expected not in text:
            if select.select([terminal], [], [], 0.2)[0]:
                text += re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x07|\r", "", os.read(terminal, 4096).decode(errors="replace"))
        return text

    def test_bash(self):
        self.type(["bash", "--norc", "-i"], f"source <('{PROGRAM}' completion bash)", ("coagula characterize --contact-tol\t", "--contact-tolerance "))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh(self):
        self.write("_coagula", self.succeed("completion", "zsh"))
        setup = "PS1='ready> '; fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -D"
        self.type(["zsh", "-f", "-i"], setup, ("coagula generate vem --target-c\t", "--target-coordination "),
                  ("coagula shear --method qua\t", "quasistatic "), ("coagula char\t", "characterize "))


class ManualPages(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("man", "-o", "pages")
        self.pages = sorted((self.folder / "pages").iterdir())

    def test_one_for_the_program_and_each_verb(self):
        names = {f"coagula-{verb.replace(' ', '-')}.1" for verb in [*VERBS, "generate brownian"]} | {"coagula.1"}
        self.assertEqual({page.name for page in self.pages}, names)
        self.assertEqual(self.succeed("man", "fit", "power-law"), (self.folder / "pages/coagula-fit-power-law.1").read_text())
        self.fail_with(2, "man", "shaer", says="did you mean 'shear'?")
        self.fail_with(3, "man", "-o", "pages", says="--force")

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_troff_reads_them_without_a_warning(self):
        for page in self.pages:
            done = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-P-c", page], capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), page)
            if page.name == "coagula-shear.1":
                text = re.sub(".\b", "", done.stdout)
                for option in options_of(self.succeed("shear", "--help")):
                    self.assertRegex(text, rf"(?m)^ +(-\w, )?{option}\b")

    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not installed")
    def test_mandoc_reads_them_without_a_warning(self):
        for page in self.pages:
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True, timeout=60)
            found = [line for line in (done.stdout + done.stderr).splitlines() if "missing date" not in line]
            self.assertEqual(found, [], page)


class Markdown(ProgramTest):
    """The same pages for the manual, whose build refuses what it cannot read."""

    def test_every_option_of_every_verb(self):
        self.succeed("man", "--format", "markdown", "-o", "pages")
        overview = (self.folder / "pages/coagula.md").read_text()
        for verb in [*VERBS, "generate brownian"]:
            name = f"coagula-{verb.replace(' ', '-')}"
            self.assertIn(f"({name}.md)", overview)
            page = (self.folder / f"pages/{name}.md").read_text()
            rows = re.findall(r"^\| (?:`-\w`, )?`(--[a-z0-9-]+)", page, re.MULTILINE)
            self.assertEqual(rows, options_of(self.succeed(*verb.split(), "--help")))
            for line in page.splitlines():
                if line.startswith("|"):
                    self.assertEqual(len(re.findall(r"(?<!\\)\|", line)), 5, line)


if __name__ == "__main__":
    unittest.main()
