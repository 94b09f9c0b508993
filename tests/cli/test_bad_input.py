# SPDX-License-Identifier: GPL-3.0-or-later
"""Every bad input is refused with one sentence that names it, exit code 2 or 1, and nothing changed on disk."""

import os
import shutil
import unittest

import h5py

from support import PACKING, VEM, ProgramTest, checksum

GOOD_CSV = "x [um],y [um],z [um]\n1,1,1\n3,1,1\n1,3,1\n5,5,5\n"
IMPORT = ["--radius", "0.5um", "--box", "8um", "-o", "out.h5"]


class StructureFiles(ProgramTest):
    def every_reader(self, name, says):
        for words in (["characterize", name], ["shear", name], ["info", name], ["export", name, "--format", "csv"]):
            with self.subTest(words=words):
                self.fail_with(2, *words, says=says)

    def test_missing(self):
        self.every_reader("absent.h5", says="absent.h5")

    def test_folder(self):
        (self.folder / "folder.h5").mkdir()
        self.every_reader("folder.h5", says="folder.h5")

    def test_empty_and_foreign(self):
        self.write("empty.h5", "")
        self.write("text.h5", "this is not HDF5\n" * 1000)
        self.every_reader("empty.h5", says="empty.h5")
        self.every_reader("text.h5", says="text.h5")

    def test_foreign_hdf5(self):
        with h5py.File(self.folder / "other.h5", "w") as file:
            file["measurements"] = [1.0, 2.0]
        self.every_reader("other.h5", says="other.h5")

    def test_truncated(self):
        content = PACKING.read_bytes()
        for part in (0.1, 0.5, 0.9, 0.999):
            path = self.folder / "cut.h5"
            path.write_bytes(content[: int(part * len(content))])
            before = checksum(path)
            self.every_reader("cut.h5", says="cut.h5")
            self.assertEqual(checksum(path), before)

    def damaged(self, change):
        shutil.copy(PACKING, self.folder / "bad.h5")
        with h5py.File(self.folder / "bad.h5", "r+") as file:
            change(file)
        before = checksum(self.folder / "bad.h5")
        for verb in ("characterize", "shear"):
            self.fail_with(2, verb, "bad.h5", says="bad.h5", may_say_nan=True)
        self.assertEqual(checksum(self.folder / "bad.h5"), before)

    def test_particle_that_is_not_a_number(self):
        def change(file):
            file["particles/trajectory/position/value"][0, 7, 1] = float("nan")
        self.damaged(change)

    def test_coincident_particles(self):
        def change(file):
            values = file["particles/trajectory/position/value"]
            values[0, 7, :] = values[0, 8, :]
        self.damaged(change)

    def test_particle_outside(self):
        def change(file):
            file["particles/trajectory/position/value"][0, 7, 1] = 1e9
        self.damaged(change)

    def test_box_that_holds_less_than_the_particles(self):
        def change(file):
            file["particles/trajectory/box/edges/value"][...] *= 1e-3
        self.damaged(change)

    def test_without_positions(self):
        def change(file):
            del file["particles/trajectory/position"]
        self.damaged(change)


class Coordinates(ProgramTest):
    def test_the_good_file_is_taken(self):
        self.write("good.csv", GOOD_CSV)
        self.succeed("import", "good.csv", *IMPORT)
        self.assertEqual(self.succeed_json("info", "out.h5")["particles"], 4)

    def refuse(self, text, says, name="bad.csv", options=IMPORT, may_say_nan=False):
        self.write(name, text)
        return self.fail_with(2, "import", name, *options, says=says, may_say_nan=may_say_nan)

    def test_missing_file(self):
        self.fail_with(2, "import", "absent.csv", *IMPORT, says="absent.csv")

    def test_unknown_ending(self):
        self.refuse(GOOD_CSV, "good.txt", name="good.txt")

    def test_empty_file_and_no_particle(self):
        self.refuse("", "bad.csv")
        self.refuse("x [um],y [um],z [um]\n", "bad.csv")

    def test_not_a_number(self):
        for cell in ("nan", "NaN", "inf", "1e400", "one", ""):
            with self.subTest(cell=cell):
                self.refuse(GOOD_CSV + f"2,{cell},6\n", "bad.csv", may_say_nan=True)

    def test_line_too_short_or_too_long(self):
        self.refuse(GOOD_CSV + "2,2\n", "bad.csv")
        self.refuse(GOOD_CSV + "2,2,6,7\n", "bad.csv")

    def test_binary(self):
        (self.folder / "bad.csv").write_bytes(os.urandom(4096))
        self.fail_with(2, "import", "bad.csv", *IMPORT, says="bad.csv")

    def test_coincident_particles(self):
        self.refuse(GOOD_CSV + "5,5,5\n", "same centre")

    def test_particle_outside_the_box(self):
        self.refuse(GOOD_CSV + "9,1,6\n", ["line 6", "outside", "--wrap"])
        self.write("bad.csv", GOOD_CSV + "9,1,6\n")
        self.succeed("import", "bad.csv", "--wrap", *IMPORT)

    def test_units(self):
        self.refuse(GOOD_CSV.replace("um", "s"), "bad.csv")
        self.refuse(GOOD_CSV, "--radius", options=["--radius", "0.5s", "--box", "8um", "-o", "out.h5"])
        self.refuse(GOOD_CSV, "--box", options=["--radius", "0.5um", "--box", "8K", "-o", "out.h5"])
        self.refuse(GOOD_CSV, "--box", options=["--radius", "0.5um", "--box", "8um,8um", "-o", "out.h5"])
        self.refuse(GOOD_CSV, "--length-unit", options=[*IMPORT, "--length-unit", "2V"])
        self.refuse(GOOD_CSV, ["--length-unit", "the edge of one"], options=[*IMPORT, "--length-unit", "px"])

    def test_length_unit_beside_another(self):
        self.refuse(GOOD_CSV, ["column x", "'um'", "--length-unit says 1 mm"], options=[*IMPORT, "--length-unit", "1mm"])
        self.write("bad.csv", GOOD_CSV)
        self.succeed("import", "bad.csv", *IMPORT, "--length-unit", "1um", "--force")
        cell = "ITEM: UNITS\nsi\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n" + 3 * "0 6\n"
        self.write("bad.dump", cell + "ITEM: ATOMS id x y z radius\n1 1 1 1 0.5\n")
        self.fail_with(2, "import", "bad.dump", "--length-unit", "1um", "-o", "bad.h5", says=["bad.dump", "unit 'm'", "--length-unit says 1 um"])

    def test_columns_without_unit(self):
        self.refuse(GOOD_CSV.replace(" [um]", ""), "length-unit")

    def test_nothing_says_radius_or_box(self):
        self.refuse(GOOD_CSV, "radius", options=["--box", "8um", "-o", "out.h5"])
        self.refuse(GOOD_CSV, "box", options=["--radius", "0.5um", "-o", "out.h5"])
        self.refuse(GOOD_CSV, "--open", options=[*IMPORT, "--open"])


class VeryFewParticles(ProgramTest):
    def test_one_and_two(self):
        for number in (1, 2):
            self.write("few.csv", "\n".join(GOOD_CSV.split("\n")[: 1 + number]) + "\n")
            self.succeed("import", "few.csv", *IMPORT, "--force")
            for verb in ("characterize", "shear"):
                self.assertNotIn("null", self.succeed(verb, "out.h5", "--json"))
            self.assertEqual(self.succeed_json("shear", "out.h5")["storage_modulus"]["mean"], 0)

    def test_an_open_sample_without_inner_particles(self):
        self.write("few.csv", GOOD_CSV)
        self.succeed("import", "few.csv", "--radius", "0.5um", "--open", "-o", "out.h5")
        self.assertIn("left out: the packing has a free surface", self.succeed("characterize", "out.h5"))
        self.fail_with(2, "characterize", "out.h5", "--only", "doh", says=["out.h5", "free surface"])
        self.fail_with(2, "shear", "out.h5", says="free surface")


class Generation(ProgramTest):
    def refuse(self, says, code=2, **changes):
        words = {"particles": "500", "voids": "250", "volume-fraction": "0.4", "radius": "0.25um", "output": "out.h5", **changes}
        options = [part for name, value in words.items() if value for part in ("--" + name.replace("_", "-"), value)]
        self.fail_with(code, "generate", "vem", *options, says=says)

    def test_volume_fraction(self):
        for value in ("0", "0.9", "-0.1", "1", "0.4m"):
            self.refuse("--volume-fraction", **{"volume-fraction": value})

    def test_number_of_particles(self):
        for value in ("0", "1", "2", "-5", "1.5", "many", "99999999999999999999"):
            self.refuse("--particles", particles=value)

    def test_missing_options(self):
        self.fail_with(2, "generate", "vem", "-o", "out.h5", "--radius", "1um", says="--volume-fraction")
        self.fail_with(2, "generate", "vem", "-o", "out.h5", "--volume-fraction", "0.4", says="--radius")
        self.fail_with(2, *VEM, says="--output")

    def test_unreachable_coordination(self):
        self.refuse("coordination", code=4, voids="2000", particles="500", target_coordination="5.9")
        self.refuse("--target-coordination", target_coordination="7")

    def test_size_distribution(self):
        self.refuse("--size-distribution", size_distribution="absent.csv", radius=None)
        self.refuse("--size-distribution", size_distribution="normal")
        self.refuse("", size_distribution="normal:-0.1")
        self.write("sizes.csv", "radius [um],fraction\n0.2,1\n0.3,\n")
        self.refuse("sizes.csv, line 3", size_distribution="sizes.csv", radius=None)
        self.write("sizes.csv", "radius [um],fraction\n0.2,1\n0.3,-1\n")
        self.refuse("sizes.csv, line 3: fraction is -1, but must be", size_distribution="sizes.csv", radius=None)
        self.write("sizes.csv", "radius,fraction\n0.2,1\n")
        self.refuse("write radius [m]", size_distribution="sizes.csv", radius=None)
        self.write("sizes.csv", "size,fraction\n0.2,1\n")
        self.refuse("sizes.csv", size_distribution="sizes.csv", radius=None)


if __name__ == "__main__":
    unittest.main()
