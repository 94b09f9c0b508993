"""Coordinates from and for other programs: trajectories, GSD against python3-gsd, VTK against VTK's own reader, columns, pixels."""

import math
import struct
import unittest

import gsd.hoomd
import h5py
import numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from support import ProgramTest

SUSPENSION = ["generate", "brownian", "--particles", "60", "--volume-fraction", "0.2", "--radius", "0.25um", "--equilibration-time", "1us",
              "--surface-potential", "0", "--stop-time", "20us", "--snapshots", "5us,10us"]


class Trajectories(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed(*SUSPENSION, "-o", "run.h5")
        self.run_positions, self.run_times = self.read("run.h5")
        self.assertEqual(self.run_positions.shape, (3, 60, 3))

    def read(self, name):
        with h5py.File(self.folder / name) as file:
            position = file["particles/trajectory/position"]
            return position["value"][:], position["time"][:]

    def test_text_formats_keep_every_digit_of_every_frame(self):
        box = h5py.File(self.folder / "run.h5")["particles/trajectory/box/edges/value"][0, 0, 0]
        for form, more in (("extxyz", []), ("dump", []), ("csv", ["--box", f"{box!r}nm"])):
            exported = self.succeed_json("export", "run.h5", "--format", form, "--trajectory")
            self.assertEqual(exported["frames"], 3)
            self.assertEqual(self.succeed_json("import", exported["output"], *more, "--frame", "all", "-o", form + ".h5")["frames"], 3)
            positions, times = self.read(form + ".h5")
            numpy.testing.assert_allclose(positions, self.run_positions, rtol=1e-15)
            numpy.testing.assert_array_equal(times, self.run_times)

    def test_one_frame_of_many(self):
        self.succeed("export", "run.h5", "--format", "extxyz", "--trajectory")
        for frame, number in (("first", 0), ("1", 1), ("last", 2)):
            self.succeed("import", "run.extxyz", "--frame", frame, "-o", "one.h5", "--force")
            numpy.testing.assert_allclose(self.read("one.h5")[0], self.run_positions[[number]], rtol=1e-15)
        self.succeed("import", "run.extxyz", "-o", "one.h5", "--force")
        numpy.testing.assert_allclose(self.read("one.h5")[0], self.run_positions[[2]], rtol=1e-15)
        self.fail_with(2, "import", "run.extxyz", "--frame", "3", "-o", "x.h5", says=["no frame 3", "3 frames", "0 to 2"])
        self.fail_with(2, "import", "run.extxyz", "--frame", "1.5", "-o", "x.h5", says="--frame")
        for form in ("lammps", "vtk"):
            self.fail_with(2, "export", "run.h5", "--format", form, "--trajectory", says="--trajectory")

    def test_gsd_as_python_reads_it(self):
        self.succeed("export", "run.h5", "--format", "gsd", "--trajectory")
        with gsd.hoomd.open(str(self.folder / "run.gsd"), "rb") as frames:
            self.assertEqual(len(frames), 3)
            for k, frame in enumerate(frames):
                self.assertEqual((frame.configuration.step, frame.particles.N), (k, 60))
                numpy.testing.assert_allclose(frame.particles.diameter, 5e-7, rtol=1e-6)
                edge = frame.configuration.box[0]
                numpy.testing.assert_allclose((frame.particles.position + edge / 2) * 1e9, self.run_positions[k], atol=1e-6 * edge * 1e9)
        self.succeed("import", "run.gsd", "--frame", "all", "-o", "back.h5")
        positions, times = self.read("back.h5")
        numpy.testing.assert_allclose(positions, self.run_positions, atol=1e-3)  # nm, of 2.7 um
        numpy.testing.assert_array_equal(times, self.run_times)


class Gsd(ProgramTest):
    def write_gsd(self, frames):
        with gsd.hoomd.open(str(self.folder / "hoomd.gsd"), "wb") as file:
            for step, positions in enumerate(frames):
                frame = gsd.hoomd.Snapshot()
                frame.configuration.step = step
                frame.configuration.box = [6, 7, 8, 0, 0, 0]
                frame.particles.N = len(positions)
                frame.particles.position = positions
                frame.particles.diameter = [1.0, 1.0, 1.25][:len(positions)]
                file.append(frame)

    def test_as_python_writes_it(self):
        first = [[0, 0, 0], [1, 1, 1], [-2, 3, 0]]
        self.write_gsd([first, [[0, 0, 1], [1, 1, 2], [-2, 3, 1]], first])
        self.fail_with(2, "import", "hoomd.gsd", "-o", "a.h5", says="--length-unit")
        self.succeed("import", "hoomd.gsd", "--length-unit", "1um", "--frame", "all", "-o", "a.h5")
        with h5py.File(self.folder / "a.h5") as file:
            found = file["particles/trajectory"]
            numpy.testing.assert_allclose(found["position/value"][0], (numpy.array(first) + [3, 3.5, 4]) * 1000)
            numpy.testing.assert_allclose(found["position/value"][2], found["position/value"][0])  # not stored twice by gsd
            numpy.testing.assert_allclose(found["position/value"][1, :, 2] - found["position/value"][0, :, 2], 1000)
            numpy.testing.assert_allclose(found["radius"][:], [500, 500, 625])
            numpy.testing.assert_allclose(numpy.diag(found["box/edges/value"][0]), [6000, 7000, 8000])

    def test_another_number_of_particles(self):
        self.write_gsd([[[0, 0, 0], [1, 1, 1]], [[0, 0, 1], [1, 1, 2], [-2, 3, 1]]])
        self.fail_with(2, "import", "hoomd.gsd", "--length-unit", "1um", "--frame", "all", "-o", "a.h5", says=["number of particles", "--frame"])
        self.assertEqual(self.succeed_json("import", "hoomd.gsd", "--length-unit", "1um", "--frame", "first", "-o", "a.h5")["particles"], 2)

    def test_damaged_files(self):
        self.write_gsd([[[0, 0, 0], [1, 1, 1], [-2, 3, 0]]])
        whole = (self.folder / "hoomd.gsd").read_bytes()
        index, entries = struct.unpack_from("<QQ", whole, 8)
        cases = [whole[:100], whole[:-200], b"no gsd" + whole[6:], whole[:8] + struct.pack("<Q", 2**63) + whole[16:],
                 whole[:16] + struct.pack("<Q", 2**60) + whole[24:], whole[:index + 8] + struct.pack("<Q", 2**61) + whole[index + 16:]]
        for number, damaged in enumerate(cases):
            (self.folder / "bad.gsd").write_bytes(damaged)
            with self.subTest(number=number):
                self.fail_with(2, "import", "bad.gsd", "--length-unit", "1um", "-o", "a.h5", says="bad.gsd")


class Endings(ProgramTest):
    def test_the_ending_of_the_output_names_the_format(self):
        self.copy_of_packing("a.h5")
        for name, form in (("b.xyz", "extxyz"), ("b.lammpstrj", "dump"), ("b.lmp", "lammps"), ("b.vtp", "vtk"), ("b.gsd", "gsd")):
            self.assertEqual(self.succeed_json("export", "a.h5", "-o", name)["format"], form)
        self.assertEqual(self.succeed_json("export", "a.h5", "--format", "csv", "-o", "c.xyz")["format"], "csv")
        self.fail_with(2, "export", "a.h5", "-o", "b.foo", says=["b.foo", ".vtp"])
        self.fail_with(2, "export", "a.h5", says=["--format", "--output"])
        self.fail_with(2, "characterize", "b.xyz", says=["b.xyz", "not an HDF5 file", "coagula import"])


class Vtk(ProgramTest):
    def test_as_vtk_reads_it(self):
        self.copy_of_packing("a.h5")
        self.succeed("shear", "a.h5")
        self.succeed("export", "a.h5", "--format", "vtk")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.folder / "a.vtp"))
        reader.Update()
        found = reader.GetOutput()
        with h5py.File(self.folder / "a.h5") as file:
            positions = file["particles/trajectory/position/value"][-1] * 1e-9
            inside = int(file["VTKHDF/NumberOfCells"][0]) - len(positions)
            radius = file["particles/trajectory/radius"][:] * 1e-9
        self.assertEqual((found.GetNumberOfPoints(), found.GetNumberOfVerts(), found.GetNumberOfLines()), (500, 500, inside))
        numpy.testing.assert_allclose([found.GetPoint(k) for k in range(500)], positions, rtol=1e-14)
        numpy.testing.assert_allclose([found.GetPointData().GetArray("radius").GetValue(k) for k in range(500)], radius, rtol=1e-14)
        longest = max(math.dist(*(found.GetPoint(found.GetCell(500 + k).GetPointId(end)) for end in (0, 1))) for k in range(inside))
        self.assertLess(longest, 2.1 * radius.max())


class Columns(ProgramTest):
    CENTRES = [(10, 20, 5), (40, 20, 5), (10, 60, 15)]

    def table(self, heading, rows):
        self.write("points.csv", heading + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))

    def test_named_columns_and_anisotropic_pixels(self):
        self.table("label,X_px,Y_px,Slice,Size", [(k, *centre, 4) for k, centre in enumerate(self.CENTRES)])
        columns = ["--columns", "x=X_px,y=y_px,z=Slice,diameter=Size"]
        words = ["import", "points.csv", "--open", "-o", "a.h5"]
        self.fail_with(2, *words, *columns, "--length-unit", "0.1um,0.1um,0.3um", says=["size", "fourth", "--length-unit"])
        self.succeed(*words, *columns, "--length-unit", "0.1um,0.1um,0.3um,0.1um")
        with h5py.File(self.folder / "a.h5") as file:
            numpy.testing.assert_allclose(file["particles/trajectory/position/value"][-1], numpy.array(self.CENTRES) * [100, 100, 300])
            numpy.testing.assert_allclose(file["particles/trajectory/radius"][:], 200)
        for wrong, says in (("x=X_p", "did you mean 'x_px'?"), ("w=X_px", "'w'"), ("x", "x=HEADING"), ("x=a,x=b", "twice")):
            self.fail_with(2, *words, "--force", "--columns", wrong, "--length-unit", "1um", says=["--columns", says])
        self.fail_with(2, *words, "--force", says="--columns x=HEADING")
        self.fail_with(2, *words, "--force", *columns, "--length-unit", "1um,2um", says="--length-unit")

    def test_diameter_and_pixels_in_the_header(self):
        self.table("x [px],y [px],z [px],diameter [um]", [(*centre, 0.5) for centre in self.CENTRES])
        self.fail_with(2, "import", "points.csv", "--open", "-o", "a.h5", says="--length-unit")
        self.assertAlmostEqual(self.succeed_json("import", "points.csv", "--open", "--length-unit", "0.1um", "-o", "a.h5")["radius_mean"], 0.25e-6)

    def test_frames_are_never_merged(self):
        self.table("frame,x [um],y [um],z [um]", [(frame, x + frame, y, z) for frame in (7, 8) for x, y, z in self.CENTRES])
        words = ["import", "points.csv", "--open", "--radius", "1um", "-o", "a.h5"]
        self.fail_with(2, *words, says=["2 frames", "7 to 8", "--frame"])
        self.fail_with(2, *words, "--frame", "0", says=["no frame 0", "7 to 8"])
        self.assertEqual(self.succeed_json(*words, "--frame", "8")["particles"], 3)
        with h5py.File(self.folder / "a.h5") as file:
            numpy.testing.assert_allclose(file["particles/trajectory/position/value"][-1][:, 0], [18000, 48000, 18000])
        self.table("frame,x [um],y [um],z [um]", [(7, *centre) for centre in self.CENTRES])
        self.succeed(*words, "--force")
        self.table("x [um],y [um],z [um]", self.CENTRES)
        self.fail_with(2, *words, "--force", "--frame", "1", says="--columns frame=HEADING")


class Dump(ProgramTest):
    HEAD = "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS {}\n-1 9\n0 10\n0 10\nITEM: ATOMS {}\n"

    def test_scaled_positions_shuffled_atoms_and_diameters(self):
        self.write("a.dump", self.HEAD.format("pp pp pp", "id xs ys zs diameter") + "2 0.5 0.5 0.5 2\n1 0.1 0.2 0.3 1\n")
        self.succeed("import", "a.dump", "--length-unit", "1um", "-o", "a.h5")
        with h5py.File(self.folder / "a.h5") as file:
            numpy.testing.assert_allclose(file["particles/trajectory/position/value"][-1], [[1000, 2000, 3000], [5000, 5000, 5000]])
            numpy.testing.assert_allclose(file["particles/trajectory/radius"][:], [500, 1000])

    def test_refused(self):
        for box, atoms, rows, says in (("pp pp ff", "id x y z radius", "1 1 1 1 1\n2 4 4 4 1\n", "some axes"), ("pp pp pp", "id x y", "1 1 1\n2 2 2\n", "x y z"),
                                       ("pp pp pp", "id x y z radius", "1 1 1 1 1\n1 4 4 4 1\n", "occurs twice"),
                                       ("pp pp pp", "id x y z radius", "1 1 1 1 1\n", "ends after 1 of 2"),
                                       ("abc origin pp pp pp", "id x y z radius", "1 1 1 1 1\n", "triclinic")):
            self.write("a.dump", self.HEAD.format(box, atoms) + rows)
            self.fail_with(2, "import", "a.dump", "--length-unit", "1um", "-o", "a.h5", says=["a.dump", says])


if __name__ == "__main__":
    unittest.main()
