# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the repository: every relative link of them leads to a file, and to a heading of it where it names one."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINK = re.compile(r"\[(?P<text>(?:[^\[\]]|\[[^\[\]]*\])*)\]\((?P<target>[^)\s]+)\)")
FENCED = re.compile(r"^(```+).*?^\1", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#+ +(.*?) *$", re.MULTILINE)
FILE_NAME = re.compile(r"[\w./-]+\.(md|toml|h5|py|csv|hpp)")
# Pages of the manual that scripts/manual-reference writes from the program; a link to them leads somewhere in the manual only, and its
# build (the test manual.builds) fails when one leads nowhere.
GENERATED = [ROOT / "docs/reference" / name for name in ("causes.md", "cpp.md", "results.md", "verbs/coagula.md")]


def links(page):
    """Text and target of each link that stays in the repository; a link within a link, as that around a picture, is one of them."""
    text = FENCED.sub("", page.read_text(encoding="utf-8"))
    while found := LINK.search(text):
        if not re.match(r"\w+:", found["target"]):
            yield found["text"], found["target"]
        text = text[:found.start()] + found["text"] + " " + text[found.end():]


def anchors(page):
    """The names that headings of a page have in links."""
    text = FENCED.sub("", page.read_text(encoding="utf-8"))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in HEADING.findall(text)}


def fault(page, text, target):
    """What is wrong with a link, in words, or nothing."""
    file, _, anchor = target.partition("#")
    there = (page.parent / file).resolve() if file else page
    if there in GENERATED:
        return None
    if not there.exists():
        return "leads nowhere"
    if anchor and anchor not in anchors(there):
        return "names no heading of that page"
    name = text.strip("`")
    if FILE_NAME.fullmatch(name) and not there.as_posix().endswith("/" + name.removeprefix("../")):
        return f"is called {name}"
    return None


class Links(unittest.TestCase):
    def test_every_relative_link(self):
        wrong, seen = [], 0
        for page in PAGES:
            for text, target in links(page):
                seen += 1
                if said := fault(page, text, target):
                    wrong.append(f"{page.relative_to(ROOT)}: the link to {target} {said}")
        self.assertFalse(wrong, "\n" + "\n".join(wrong))
        self.assertGreater(seen, 100)

    def test_faults_are_found(self):
        page = ROOT / "docs/index.md"
        self.assertIsNone(fault(page, "the figures", "figures.md#one-curve-per-file"))
        self.assertIsNone(fault(page, "first-packing.md", "tutorial/first-packing.md"))
        self.assertIsNone(fault(page, "results", "reference/results.md"))
        for text, target, said in [("a page", "diagnosis.md", "nowhere"), ("a folder", "../no-such-folder", "nowhere"),
                                   ("a page", "figures.md#no-such-heading", "no heading"), ("calibration.md", "how-to/stiffness.md", "is called"),
                                   ("`docs/diagnosis.md`", "explanation/diagnosis.md", "is called")]:
            self.assertIn(said, fault(page, text, target) or "")

    def test_generated_pages_are_written_by_the_script(self):
        script = (ROOT / "scripts/manual-reference").read_text(encoding="utf-8")
        for page in GENERATED:
            self.assertIn(f'folder / "{page.relative_to(ROOT / "docs/reference").parts[0]}"', script)


if __name__ == "__main__":
    unittest.main()
