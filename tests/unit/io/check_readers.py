# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a structure file with h5py, MDAnalysis and VTK and compares what they see: check_readers.py WRITE_EXAMPLE FOLDER.
Debian: python3-h5py, python3-mdanalysis, python3-vtk9.
"""
import hashlib
import json
import pathlib
import subprocess
import sys
import warnings

warnings.filterwarnings("ignore")
import h5py
import MDAnalysis
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

write_example, folder = sys.argv[1], pathlib.Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
path, expected_path = folder / "example.h5", folder / "example.json"
subprocess.run([write_example, path, expected_path], check=True)
expected = json.loads(expected_path.read_text())
positions = numpy.array(expected["positions_m"])
radii = numpy.array(expected["radii_m"])
box = numpy.array(expected["box_m"])
bonds = numpy.array(expected["bonds"], dtype=int)
branch = numpy.array(expected["branch_m"])


def same(found, wanted, tolerance=0.0):
    found, wanted = numpy.asarray(found), numpy.asarray(wanted)
    assert found.shape == wanted.shape, (found.shape, wanted.shape)
    assert numpy.allclose(found, wanted, rtol=tolerance, atol=0), numpy.abs(found - wanted).max()


def all_datasets(file):
    paths = []
    file.visititems(lambda name, item: paths.append(name) if isinstance(item, h5py.Dataset) else None)
    return paths


def check_h5py():
    with h5py.File(path) as file:
        assert list(file["h5md"].attrs["version"]) == [1, 1]
        assert "name" in file["h5md/author"].attrs and file["h5md/creator"].attrs["name"] == "coagula"
        group = file["particles/trajectory"]
        assert group["box"].attrs["dimension"] == 3
        assert list(group["box"].attrs["boundary"]) == ["periodic"] * 3
        for name in ("position/value", "box/edges/value", "radius"):
            assert group[name].attrs["unit"] == "nm"
        assert group["box/edges/step"] == group["position/step"], "step must be one object under two names"
        same(group["box/edges/value"], [numpy.diag(box * 1e9)])
        same(group["position/value"], [positions * 1e9])
        same(group["radius"], radii * 1e9)
        same(group["id"], numpy.arange(len(radii)))
        assert hashlib.sha256(group["position/value"][()].tobytes()).hexdigest() == expected["positions_sha256"]
        assert group["position/value"].compression == "gzip" and group["position/value"].shuffle
        connectivity = file["connectivity/bonds"]
        same(connectivity, bonds)
        same(file["connectivity/branch_vectors"], branch)
        assert file[connectivity.attrs["particles_group"]] == group
        same(file["mechanics/linear/matrix"], [[1, 2], [3, 4]])
        assert file["mechanics/linear/modulus"][()] == 1.5e6 and file["mechanics/linear/modulus"].attrs["unit"] == b"Pa"
        assert file["provenance/0001_generate_test/stage"][()].decode() == "generate test"
        for name in all_datasets(file):
            if name.split("/")[0] != "VTKHDF" or name.split("/")[1] == "PointData":
                assert {"unit", "description"} <= set(file[name].attrs), name


def check_mdanalysis():
    named = path.with_suffix(".h5md")  # MDAnalysis makes a topology from the file itself only under this ending
    named.unlink(missing_ok=True)
    named.hardlink_to(path)
    universe = MDAnalysis.Universe(str(named))
    angstrom = positions * 1e10
    same(universe.atoms.positions, angstrom.astype(numpy.float32), 3e-7)  # single precision
    same(universe.dimensions, numpy.append(box * 1e10, [90, 90, 90]).astype(numpy.float32), 3e-7)
    assert len(universe.trajectory) == 1
    loaded = MDAnalysis.Universe.empty(len(radii)).load_new(str(path), format="H5MD")
    same(loaded.atoms.positions, universe.atoms.positions)


def check_vtk():
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    same(points, positions.astype(numpy.float32))
    data = {grid.GetPointData().GetArrayName(i): vtk_to_numpy(grid.GetPointData().GetArray(i))
            for i in range(grid.GetPointData().GetNumberOfArrays())}
    same(data["radius"], radii)
    same(data["coordination"], numpy.bincount(bonds.ravel(), minlength=len(radii)))
    same(data["doubled_position"], 2 * positions)
    inside = (abs(positions[bonds[:, 1]] - positions[bonds[:, 0]] - branch) < 0.5 * box).all(axis=1)
    assert 0 < inside.sum() < len(bonds), "the example needs bonds inside the box and through its boundary"
    types = vtk_to_numpy(grid.GetCellTypesArray())
    same(types, [1] * len(radii) + [3] * inside.sum())
    cells = grid.GetCells()
    same(vtk_to_numpy(cells.GetConnectivityArray()), numpy.concatenate([numpy.arange(len(radii)), bonds[inside].ravel()]))
    ends = points[bonds[inside]]
    assert (abs(ends[:, 1] - ends[:, 0]) < 0.5 * box).all(), "a line crosses the box"


for check in (check_h5py, check_mdanalysis, check_vtk):
    check()
    print(check.__name__, "ok")
