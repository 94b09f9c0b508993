# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates from and for other programs: trajectories, GSD against python3-gsd, VTK against VTK's own reader, columns, pixels."""

import math
import os
import struct
import unittest
from pathlib import Path

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
            units = ["--dump-units"] if form == "dump" else []
            exported = self.succeed_json("export", "run.h5", "--format", form, "--trajectory", *units)
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


    def test_dumps_as_mdanalysis_reads_them(self):
        import MDAnalysis

        self.succeed("export", "run.h5", "--format", "dump", "--trajectory")
        universe = MDAnalysis.Universe(str(self.folder / "run.dump"), topology_format="LAMMPSDUMP", format="LAMMPSDUMP", lammps_coordinate_convention="unscaled")
        self.assertEqual((len(universe.atoms), len(universe.trajectory)), (60, 3))
        for k, frame in enumerate(universe.trajectory):
            numpy.testing.assert_allclose(frame.positions * 1e9, self.run_positions[k], rtol=1e-6, atol=1e-3)
        self.succeed("import", "run.dump", "--length-unit", "1m", "--frame", "first", "-o", "first.h5")
        numpy.testing.assert_allclose(self.read("first.h5")[0], self.run_positions[:1], rtol=1e-12)
        self.fail_with(2, "export", "run.h5", "--format", "csv", "--dump-units", says=["--dump-units", "csv"])


class Gsd(ProgramTest):
    POSITIONS = [[0, 0, 0], [1, 1, 1], [-2, 3, 0]]

    def write_one(self, dimensions=None, box=(6, 7, 8, 0, 0, 0), state=None, **particles):
        """hoomd.gsd of one frame with these attributes of its particles."""
        with gsd.hoomd.open(str(self.folder / "hoomd.gsd"), "wb") as file:
            frame = gsd.hoomd.Snapshot()
            frame.configuration.box = list(box)
            frame.configuration.dimensions = dimensions
            frame.particles.N = 3
            frame.particles.position = self.POSITIONS
            for name, value in particles.items():
                setattr(frame.particles, name, value)
            frame.state = state or {}
            file.append(frame)

    def radii(self):
        self.succeed("import", "hoomd.gsd", "--length-unit", "1um", "-o", "a.h5", "--force")
        with h5py.File(self.folder / "a.h5") as file:
            return list(file["particles/trajectory/radius"][:])

    def refuse(self, *says, words=()):
        self.fail_with(2, "import", "hoomd.gsd", "--length-unit", "1um", *words, "-o", "none.h5", says=["hoomd.gsd", *says])

    def test_two_dimensions_are_refused(self):
        for lz, dimensions in ((1, 2), (0, 2), (0, None), (8, 2)):
            self.write_one(dimensions=dimensions, box=(6, 7, lz, 0, 0, 0))
            self.refuse("2 dimensions", "three-dimensional")
            self.refuse("2 dimensions", "three-dimensional", words=["--open", "--radius", "1um"])
        self.write_one(dimensions=3)
        self.assertEqual(self.radii(), [500] * 3)

    def test_shapes_of_the_types_are_the_radii(self):
        spheres = [{"type": "Sphere", "diameter": 1.5}, {"type": "Ellipsoid", "a": 0.5, "b": 0.5, "c": 0.5}, {}]
        self.write_one(types=["A", "B", "C"], typeid=[1, 0, 2], type_shapes=spheres)
        self.assertEqual(self.radii(), [500, 750, 500])
        self.write_one(types=["A", "B", "C"], typeid=[2, 0, 2], type_shapes=spheres, diameter=[0.5, 1.5, 0.75])
        self.assertEqual(self.radii(), [250, 750, 375])
        self.write_one(types=["A"], type_shapes=[{"type": "Sphere", "diameter": 1.5}], diameter=[1, 1.5, 1.5])
        self.refuse("particle 0", "diameter 1", "1.5", "--radius")
        self.write_one(types=["A", "B"], typeid=[0, 0, 0], type_shapes=[{"type": "Sphere", "diameter": 1.5}, {"type": "Polygon", "vertices": []}])
        self.assertEqual(self.radii(), [750] * 3)  # no particle is of the other type

    def test_other_shapes_are_refused(self):
        for shape, says in (({"type": "ConvexPolyhedron", "rounding_radius": 0, "vertices": [[1, 0, 0]]}, "ConvexPolyhedron"),
                            ({"type": "Ellipsoid", "a": 0.5, "b": 0.5, "c": 0.6}, "Ellipsoid"), ({"type": "Mesh"}, "Mesh"),
                            ({"type": "SphereUnion", "diameters": [1], "centers": [[0, 0, 0]]}, "SphereUnion"),
                            ({"type": "Sphere"}, "no number 'diameter'"), ({"type": 3}, "shape 3")):
            self.write_one(types=["A", "rod"], typeid=[0, 1, 0], type_shapes=[{}, shape])
            self.refuse("type 'rod'", says)
        found = self.succeed_json("import", "hoomd.gsd", "--length-unit", "1um", "--radius", "0.1um", "-o", "b.h5")
        self.assertAlmostEqual(found["radius_mean"], 1e-7, delta=1e-15)

    def test_state_of_monte_carlo(self):
        self.write_one(types=["A", "B"], typeid=[0, 1, 0], state={"hpmc/sphere/radius": [0.25, 0.75]})
        self.assertEqual(self.radii(), [250, 750, 250])
        self.write_one(state={"hpmc/convex_polyhedron/N": [1], "hpmc/convex_polyhedron/vertices": [[0, 0, 1]]})
        self.refuse("convex_polyhedron")
        self.write_one(state={"hpmc/ellipsoid/a": [0.5], "hpmc/ellipsoid/b": [0.5], "hpmc/ellipsoid/c": [0.6]})
        self.refuse("Ellipsoid")
        self.write_one(types=["A"], state={"hpmc/sphere/radius": [0.25]}, type_shapes=[{"type": "Sphere", "diameter": 1.5}])
        self.refuse("1.5", "0.5", "Monte Carlo")

    def test_rigid_bodies_are_refused(self):
        self.write_one(body=[-1, 2, 2])
        self.refuse("particle 1", "rigid body")
        self.write_one(body=[-1, -1, -1])
        self.assertEqual(self.radii(), [500] * 3)

    def test_what_other_programs_wrote(self):
        data = Path(os.environ["COAGULA_DATASETS"]) / "foreign_structures"
        for name in ("g_2d0.gsd", "g_2d1.gsd"):
            self.fail_with(2, "import", data / name, "--length-unit", "1um", "-o", "a.h5", says=[name, "2 dimensions"])
        found = self.succeed_json("import", data / "gx_hcp3.gsd", "--length-unit", "1um", "-o", "a.h5")
        self.assertEqual((found["particles"], found["coordination"], found["warnings"]), (108, 12, []))
        self.assertAlmostEqual(found["volume_fraction"], math.pi / math.sqrt(18), delta=1e-5)
        self.assertAlmostEqual(found["nearest_distance"]["median"], 1, delta=1e-5)

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


class H5md(ProgramTest):
    POSITIONS = numpy.array([[[1, 1, 1], [2, 2, 2], [3, 3, 3]], [[1.5, 1, 1], [2.5, 2, 2], [3.5, 3, 3]]])

    def write_h5md(self, change=None, group="all", edges=(6.0, 7.0, 8.0), radius=None, unit=None):
        """a.h5md as other programs write it: time-dependent positions, no unit, no radii unless they are given."""
        with h5py.File(self.folder / "a.h5md", "w") as file:
            file.create_group("h5md").attrs["version"] = [1, 1]
            particles = file.create_group("particles/" + group)
            particles.create_dataset("position/value", data=self.POSITIONS)
            particles["position/step"], particles["position/time"] = [0, 10], [0.0, 0.1]
            box = particles.create_group("box")
            box.attrs["boundary"], box.attrs["dimension"] = ["periodic"] * 3, 3
            box["edges"] = edges
            if radius is not None:
                particles["radius"] = radius
            for name in ("position/value", "box/edges", "radius"):
                if unit and name in particles:
                    particles[name].attrs["unit"] = unit
            if change:
                change(particles)

    def found(self, *words, frames=False):
        self.succeed("import", "a.h5md", *words, "-o", "b.h5", "--force")
        with h5py.File(self.folder / "b.h5") as file:
            found = file["particles/trajectory"]
            positions = found["position/value"][:] / 1000
            return positions if frames else (positions[-1], found["radius"][:] / 1000, numpy.diag(found["box/edges/value"][0]) / 1000)

    def test_unit_and_radius_that_are_missing(self):
        self.write_h5md()
        self.fail_with(2, "import", "a.h5md", "--radius", "0.5um", "-o", "b.h5", says=["a.h5md", "position", "--length-unit"])
        self.fail_with(2, "import", "a.h5md", "--length-unit", "1um", "-o", "b.h5", says=["names no radii", "--radius"])
        self.fail_with(2, "characterize", "a.h5md", says=["--length-unit"])
        positions, radii, box = self.found("--length-unit", "1um", "--radius", "0.5um")
        numpy.testing.assert_allclose(positions, self.POSITIONS[1])
        numpy.testing.assert_allclose(radii, [0.5] * 3)
        numpy.testing.assert_allclose(box, [6, 7, 8])

    def test_units_of_the_file_come_first(self):
        self.write_h5md(radius=[0.1, 0.2, 0.3], unit="Angstrom")
        positions, radii, box = self.found("--length-unit", "1um")
        numpy.testing.assert_allclose(positions, self.POSITIONS[1] * 1e-4)
        numpy.testing.assert_allclose(radii, numpy.array([0.1, 0.2, 0.3]) * 1e-4)
        self.write_h5md(radius=[0.5, 0.5, 0.5], unit="sigma")
        self.fail_with(2, "import", "a.h5md", "-o", "c.h5", says=["'sigma'", "not a length"])
        numpy.testing.assert_allclose(self.found("--length-unit", "1um")[0], self.POSITIONS[1])

    def test_frames_boxes_and_numbers(self):
        def shuffled(particles):
            particles.create_dataset("id/value", data=[[1, 2, 3], [3, 2, 1]])
            particles["id/step"] = [0, 10]
            del particles["box/edges"]
            particles.create_dataset("box/edges/value", data=[numpy.diag([6.0, 7, 8])] * 2)
            particles["box/edges/step"] = [0, 10]
            particles.create_dataset("diameter", data=[[1.0, 1, 1]] * 1)
            del particles["diameter"]
            particles["diameter"] = [1.0, 1.0, 1.0]

        self.write_h5md(shuffled)
        numpy.testing.assert_allclose(self.found("--length-unit", "1um")[0], self.POSITIONS[1][::-1])
        numpy.testing.assert_allclose(self.found("--length-unit", "1um", "--frame", "first")[0], self.POSITIONS[0])
        frames = self.found("--length-unit", "1um", "--frame", "all", frames=True)
        numpy.testing.assert_allclose(frames, [self.POSITIONS[0], self.POSITIONS[1][::-1]])
        self.fail_with(2, "import", "a.h5md", "--length-unit", "1um", "--frame", "2", "-o", "c.h5", says=["no frame 2", "0 to 1"])

    def test_the_box_may_begin_elsewhere(self):
        def shifted(particles):
            particles["box/offset"] = [-2.0, -2.0, -2.0]

        self.write_h5md(shifted)
        numpy.testing.assert_allclose(self.found("--length-unit", "1um", "--radius", "0.1um")[0], self.POSITIONS[1] + 2)

    def test_refused(self):
        def other(name, value):
            def change(particles):
                if isinstance(value, list) and value and isinstance(value[0], str):
                    particles["box"].attrs[name] = value
                else:
                    if name in particles:
                        del particles[name]
                    particles[name] = value
            return change

        words = ["import", "a.h5md", "--length-unit", "1um", "--radius", "0.1um", "-o", "c.h5"]
        for change, says in ((other("boundary", ["periodic", "periodic", "mirror"]), "boundary"), (other("box/edges", [6.0, 7.0, 0.0]), "positive"),
                             (other("box/edges", [[6.0, 1, 0], [6.0, 1, 0], [0, 0, 8]]), "one plane"), (other("id", [1, 1, 2]), "occurs twice"),
                             (other("id", [1, 2]), "shape"), (other("id", [1, -1, 2]), "below 0"), (other("box/offset", [0.0, 0.0]), "shape")):
            self.write_h5md(change)
            self.fail_with(2, *words, says=["a.h5md", says])
        self.write_h5md(lambda particles: particles.__delitem__("box"))
        self.fail_with(2, *words, says="names no box")
        self.assertEqual(self.succeed_json(*words, "--box", "10um")["particles"], 3)
        self.fail_with(2, "import", "a.h5md", "--columns", "x=X", "-o", "d.h5", says="--columns")

    def test_files_of_coagula(self):
        self.copy_of_packing("a.h5")
        self.succeed("import", "a.h5", "-o", "b.h5")
        with h5py.File(self.folder / "a.h5") as one, h5py.File(self.folder / "b.h5") as other:
            for name in ("position/value", "radius", "box/edges/value"):
                numpy.testing.assert_allclose(one["particles/trajectory"][name][:], other["particles/trajectory"][name][:], rtol=1e-15)


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
        for box, atoms, rows, says in (("pp pp", "id x y z radius", "1 1 1 1 1\n2 4 4 4 1\n", "each axis"), ("pp pp pp", "id x y", "1 1 1\n2 2 2\n", "x y z"),
                                       ("pp pp pp", "id x y z radius", "1 1 1 1 1\n1 4 4 4 1\n", "occurs twice"),
                                       ("pp pp pp", "id x y z radius", "1 1 1 1 1\n", "ends after 1 of 2"),
                                       ("abc origin pp pp pp", "id x y z radius", "1 1 1 1 1\n", "4 numbers")):
            self.write("a.dump", self.HEAD.format(box, atoms) + rows)
            self.fail_with(2, "import", "a.dump", "--length-unit", "1um", "-o", "a.h5", says=["a.dump", says])


if __name__ == "__main__":
    unittest.main()
