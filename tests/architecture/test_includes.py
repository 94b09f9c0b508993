# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes run one way: down the libraries, and inside a library down its rooms."""

import os
import re
import tempfile
import unittest
from pathlib import Path

# A library and those that its files may include besides their own.
BELOW = {
    "common": [],
    "common/io": ["common"],
    "generators": ["common"],
    "characterize": ["common"],
    "mechanics": ["common"],
    "diagnose": ["common", "mechanics"],
    "experiment": ["common", "common/io", "generators", "characterize", "mechanics", "diagnose"],
    "report": ["common", "common/io", "generators", "characterize", "mechanics", "diagnose", "experiment"],
    "stages": ["common", "common/io", "generators", "characterize", "mechanics", "diagnose", "experiment", "report"],
    "tools": ["common", "common/io", "generators", "characterize", "mechanics", "diagnose", "experiment", "report", "stages"],
    "python": ["common", "common/io", "generators", "characterize", "mechanics", "diagnose", "experiment", "report", "stages"],
}

# The floors of a library, the lowest first; rooms on one floor do not include each other. "" is what lies in no room. A public header
# without a folder of its own belongs to the lowest room that has a source of its name.
FLOORS = {
    "common": [[""], ["dem"]],
    "characterize": [[""], ["geometry"], ["sample"], ["pores", "pairs", "topology"], ["rigidity"], ["measures"]],
    "mechanics": [[""], ["solvers", "curves"], ["response"], ["quasistatic", "explicit", "petsc"], ["series"]],
    "diagnose": [["data"], ["observables"], ["noise", "responses"], ["mechanisms"], ["chain"], ["infer"]],
    "report": [[""], ["figures"]],
    "tools": [["cli"], ["verbs"]],
}

INCLUDE = re.compile(r'^\s*#include\s*(?:"([^"]+)"|<coagula/([^>]+)>)', re.MULTILINE)


class Tree:
    """The files of all libraries, where each belongs and what it includes."""

    def __init__(self, root):
        self.root = Path(root)
        self.files = {}  # path -> (library, room)
        for library in BELOW:
            for path in sorted((self.root / library).rglob("*.[ch]pp")):
                if library == "common" and path.is_relative_to(self.root / "common" / "io"):
                    continue
                self.files[path] = (library, self.folder(library, path))
        for path, (library, room) in self.files.items():
            if room == "" and library in FLOORS:
                self.files[path] = (library, self.room_of_source(library, path))

    def folder(self, library, path):
        """The room that a path names: its folders below src, or below the public headers."""
        parts = path.relative_to(self.root / library).parts[:-1]
        for start in (("include", "coagula", library.split("/")[-1]), ("src",)):
            if parts[:len(start)] == start:
                parts = parts[len(start):]
                break
        return parts[0] if parts else ""

    def room_of_source(self, library, header):
        """The lowest room with a source of this name: a calculation has the name of its measure."""
        floors = [room for rooms in FLOORS[library] for room in rooms]
        rooms = {self.folder(library, path) for path in self.files if path.stem == header.stem and path.suffix == ".cpp" and
                 self.files[path][0] == library}
        if not rooms and "" not in floors:
            raise AssertionError(f"{header.relative_to(self.root)}: no source of {library} has its name, so that it is in no room")
        return min(rooms, key=floors.index, default="")

    def included(self, path):
        """The files of the tree that a file includes."""
        for quoted, public in INCLUDE.findall(path.read_text()):
            found = self.public_header(public) if public else self.own_header(path, quoted)
            if found in self.files:
                yield found

    def public_header(self, name):
        library = "common/io" if name.startswith("io/") else name.split("/")[0]
        return self.root / library / "include" / "coagula" / name

    def own_header(self, path, name):
        """Beside the file, then in the folders that the compiler searches: those of its library, then the program's."""
        library = self.files[path][0]
        for folder in (path.parent, self.root / library / "src", self.root / library, self.root / "tools"):
            found = Path(os.path.normpath(folder / name))
            if found in self.files:
                return found
        return None

    def upward(self):
        """A sentence for each include that does not run down."""
        for path in self.files:
            for other in self.included(path):
                sentence = self.complaint(*self.files[path], *self.files[other])
                if sentence:
                    yield f"{path.relative_to(self.root)} includes {other.relative_to(self.root)}: {sentence}"

    def complaint(self, library, room, other_library, other_room):
        if other_library != library:
            return "" if other_library in BELOW[library] else f"{library} may not include {other_library}"
        floors = FLOORS.get(library, [])
        floor = {each: number for number, rooms in enumerate(floors) for each in rooms}
        if room == other_room or not floors:
            return ""
        for each in (room, other_room):
            if each not in floor:
                return f"{library} has no room '{each}' (FLOORS in {Path(__file__).name})"
        return "" if floor[other_room] < floor[room] else f"'{other_room}' is not below '{room}'"


class Includes(unittest.TestCase):
    maxDiff = None

    def test_run_down_the_libraries_and_their_rooms(self):
        tree = Tree(os.environ["COAGULA_SOURCE"])
        self.assertGreater(len(tree.files), 500)
        self.assertEqual(list(tree.upward()), [])

    def made(self, **sources):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name, text in sources.items():
            path = Path(folder.name) / name.replace("__", "/").replace("_hpp", ".hpp").replace("_cpp", ".cpp")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return list(Tree(folder.name).upward())

    def test_an_arrow_upward_is_found(self):
        files = {"diagnose__src__data__table_hpp": "", "diagnose__src__noise__floor_hpp": "", "diagnose__src__responses__run_hpp": ""}
        self.assertEqual(self.made(**files, diagnose__src__noise__floor_cpp='#include "data/table.hpp"\n'), [])
        upward, = self.made(**files, diagnose__src__data__table_cpp='#include "noise/floor.hpp"\n')
        self.assertEqual(upward, "diagnose/src/data/table.cpp includes diagnose/src/noise/floor.hpp: 'noise' is not below 'data'")
        sibling, = self.made(**files, diagnose__src__noise__floor_cpp='#include "responses/run.hpp"\n')
        self.assertIn("'responses' is not below 'noise'", sibling)

    def test_a_public_header_is_in_the_room_of_its_source(self):
        files = {"diagnose__include__coagula__diagnose__verdict_hpp": "", "diagnose__src__infer__verdict_cpp": ""}
        upward, = self.made(**files, diagnose__src__data__table_cpp="#include <coagula/diagnose/verdict.hpp>\n")
        self.assertIn("'infer' is not below 'data'", upward)
        with self.assertRaisesRegex(AssertionError, "no source of diagnose"):
            self.made(diagnose__include__coagula__diagnose__verdict_hpp="")

    def test_siblings_among_libraries_do_not_include_each_other(self):
        upward, = self.made(mechanics__include__coagula__mechanics__linear_hpp="",
                            generators__src__voids_cpp="#include <coagula/mechanics/linear.hpp>\n")
        self.assertIn("generators may not include mechanics", upward)

    def test_a_room_that_nobody_has_placed_is_told(self):
        upward, = self.made(tools__cli__option_hpp="", tools__pages__page_cpp='#include "cli/option.hpp"\n')
        self.assertIn("tools has no room 'pages'", upward)


if __name__ == "__main__":
    unittest.main()
