// SPDX-License-Identifier: GPL-3.0-or-later
#include "values.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <tuple>
#include <vector>

namespace coagula::python {

namespace {

using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Lengths [m] from numbers or texts with a unit, one or many.
Rows lengths_of(const py::object& value) {
    const auto parsed = [](const py::handle& item) -> py::object {
        return py::isinstance<py::str>(item) ? py::cast(io::parse_quantity(item.cast<std::string>(), "m"))
                                             : py::reinterpret_borrow<py::object>(item);
    };
    if (py::isinstance<py::str>(value)) {
        return Rows(py::list(py::make_tuple(parsed(value))));
    }
    if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) {
        return value.cast<Rows>();
    }
    py::list numbers;
    for (const py::handle& item : value) {
        numbers.append(parsed(item));
    }
    return Rows(numbers);
}

Eigen::Matrix3Xd positions_of(const Rows& rows) {
    if (rows.ndim() != 2 || rows.shape(1) != 3) {
        throw InputError("positions must be an array of the shape (N, 3), one row per particle");
    }
    if (rows.shape(0) == 0) {
        throw InputError("the packing has no particles");
    }
    return Eigen::Matrix3Xd::Map(rows.data(), 3, rows.shape(0));
}

/// One radius for all, or one for each.
Eigen::VectorXd radii_of(const Rows& radii, Index particles) {
    if (radii.size() == 1) {
        return Eigen::VectorXd::Constant(particles, *radii.data());
    }
    if (radii.ndim() != 1 || radii.size() != particles) {
        throw InputError("radii must be one number, or one for each of the " + std::to_string(particles) + " particles");
    }
    return Eigen::VectorXd::Map(radii.data(), radii.size());
}

/// @param box edge lengths, or edge vectors as rows, of a box with a corner at the origin; otherwise the box around the spheres,
/// without periodicity.
std::shared_ptr<Packing> make_packing(const Rows& positions, const py::object& radii, const py::object& box, bool wrap,
                                      const std::optional<std::array<bool, 3>>& periodic) {
    auto packing = std::make_shared<Packing>();
    packing->positions = positions_of(positions);
    packing->radii = radii_of(lengths_of(radii), packing->positions.cols());
    if (!box.is_none()) {
        const Rows edges = lengths_of(box);
        if (edges.size() != 1 && edges.size() != 3 && edges.size() != 9) {
            throw InputError("the box must have one edge length, three, or three edge vectors");
        }
        Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity() * *edges.data();
        if (edges.size() > 1) {
            matrix = edges.size() == 3 ? Eigen::Matrix3d(Eigen::Vector3d::Map(edges.data()).asDiagonal())
                                       : Eigen::Matrix3d(Eigen::Matrix3d::Map(edges.data()));
        }
        packing->cell = Cell::of_edges(Eigen::Vector3d::Zero(), matrix, periodic.value_or(std::array{true, true, true}));
    } else {
        if (periodic) {
            throw InputError("periodic says along which edges a box is periodic: give the box, too");
        }
        const Eigen::Vector3d lower = (packing->positions.rowwise() - packing->radii.transpose()).rowwise().minCoeff();
        const Eigen::Vector3d upper = (packing->positions.rowwise() + packing->radii.transpose()).rowwise().maxCoeff();
        packing->cell = Cell::open(lower, upper - lower);
    }
    for (Index particle = 0; wrap && particle < packing->size(); ++particle) {
        packing->positions.col(particle) = packing->cell.wrap(packing->positions.col(particle));
    }
    check(*packing);
    return packing;
}

/// The entries of a vector or matrix.
template <class Matrix>
std::vector<double> numbers_of(const Matrix& matrix) {
    return {matrix.data(), matrix.data() + matrix.size()};
}

void define_packing(py::module_& module) {
    py::class_<Packing, std::shared_ptr<Packing>>(
        module, "Packing",
        "Spheres in a box. The numbers are copied once; the arrays of the packing are read-only views of "
        "the copy.\n\n"
        "Parameters\n----------\n"
        "positions : ArrayLike\n    Centres [m], array (N, 3).\n"
        "radii : ArrayLike | str\n    One radius, or one for each particle [m].\n"
        "box : ArrayLike | str | None\n    Edge lengths of a box with a corner at the origin [m], one or three, or its edge "
        "vectors as the rows of an array (3, 3); None: a sample with a free surface.\n"
        "wrap : bool\n    Bring particles outside the periodic box back in; otherwise they are "
        "an error.\n"
        "periodic : tuple[bool, bool, bool] | None\n    Whether the box is periodic along each of its edges; None: along all.")
        .def(py::init(&make_packing), py::arg("positions"), py::arg("radii"), py::arg("box") = py::none(), py::arg("wrap") = false,
             py::arg("periodic") = py::none())
        .def_property_readonly(
            "positions", [](const py::object& self) { return rows_of(self.cast<const Packing&>().positions, self); },
            "Centres [m], array (N, 3), a read-only view of the packing's own numbers.")
        .def_property_readonly(
            "radii",
            [](const py::object& self) {
                const auto& radii = self.cast<const Packing&>().radii;
                return view(radii.data(), {radii.size()}, self);
            },
            "Radii [m], array (N,), a read-only view of the packing's own numbers.")
        .def_property_readonly(
            "box", [](const Packing& packing) -> Eigen::Vector3d { return packing.cell.edge_lengths(); },
            "Edge lengths of the box [m], array (3,).")
        .def_property_readonly(
            "edges", [](const Packing& packing) -> Eigen::Matrix3d { return packing.cell.edges().transpose(); },
            "Edge vectors of the box [m], array (3, 3), one per row.")
        .def_property_readonly(
            "periodic_edges",
            [](const Packing& packing) {
                const auto& of = packing.cell.periodicity();
                return std::tuple(of[0], of[1], of[2]);
            },
            "Whether the box is periodic along each of its edges.")
        .def_property_readonly(
            "origin", [](const Packing& packing) -> Eigen::Vector3d { return packing.cell.origin(); },
            "Lowest corner of the box [m], array (3,).")
        .def_property_readonly(
            "periodic", [](const Packing& packing) { return packing.cell.is_periodic(); },
            "Whether the box is periodic along all edges; otherwise the packing has a free surface.")
        .def_property_readonly("volume_fraction", &volume_fraction,
                               "Solid volume over the volume of the box [1]; overlaps count twice.")
        .def_property_readonly("mean_radius", &mean_radius, "r0 [m], by which reduced lengths are divided.")
        .def_property_readonly("monodisperse", &is_monodisperse, "Whether all radii are equal to within 1e-12.")
        .def("__len__", &Packing::size)
        .def("__repr__",
             [](const Packing& packing) {
                 return "Packing of " + std::to_string(packing.size()) + " particles, " + coagula::describe(packing.cell);
             })
        .def(py::pickle(
            [](const Packing& packing) {
                const Cell& cell = packing.cell;
                return py::make_tuple(packing.positions, packing.radii, numbers_of(cell.origin()), numbers_of(cell.edges()),
                                      cell.periodicity());
            },
            [](const py::tuple& state) {
                const auto origin = state[2].cast<std::vector<double>>();
                const auto edges = state[3].cast<std::vector<double>>();
                const Cell cell = Cell::of_edges(Eigen::Vector3d::Map(origin.data()), Eigen::Matrix3d::Map(edges.data()),
                                                 state[4].cast<std::array<bool, 3>>());
                return std::make_shared<Packing>(
                    Packing{cell, state[0].cast<Eigen::Matrix3Xd>(), state[1].cast<Eigen::VectorXd>()});
            }));
}

void define_bonds(py::module_& module) {
    py::class_<ContactNetwork, std::shared_ptr<ContactNetwork>>(
        module, "Bonds", "Pairs of particles that are bonded or in contact, each once, sorted.")
        .def_property_readonly(
            "ends", [](const py::object& self) { return rows_of(self.cast<const ContactNetwork&>().ends, self); },
            "Indices of the two particles, from 0, array (M, 2), a read-only view.")
        .def_property_readonly(
            "branch", [](const py::object& self) { return rows_of(self.cast<const ContactNetwork&>().branch, self); },
            "Centre of the second particle minus that of the first, through the periodic boundary [m], array (M, 3): a read-only "
            "view.")
        .def_readonly("particles", &ContactNetwork::particles, "Number of particles N.")
        .def_property_readonly("coordination", &coordination_number, "Mean number of bonds of a particle, 2 M / N.")
        .def_property_readonly(
            "counts", [](const ContactNetwork& bonds) { return contact_counts(bonds); },
            "Number of bonds of every particle, array (N,).")
        .def("__len__", &ContactNetwork::size)
        .def("__repr__", [](const ContactNetwork& bonds) {
            return std::to_string(bonds.size()) + " bonds of " + std::to_string(bonds.particles) + " particles";
        });
    module.def(
        "find_contacts",
        [](const Packing& packing, double tolerance) {
            if (!(tolerance >= 0 && tolerance <= 1)) {
                throw InputError("tolerance is " + to_text(tolerance) +
                                 ", but must be 0 .. 1: pairs nearer than (1 + tolerance) "
                                 "(r_i + r_j) are in contact");
            }
            return std::make_shared<ContactNetwork>(find_contacts(packing, tolerance));
        },
        py::arg("packing"), py::arg("tolerance") = 0.01, py::call_guard<py::gil_scoped_release>());
}

py::object value_of(const io::Dataset& dataset, const py::handle& owner) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return py::str(*text);
    }
    return std::visit(
        [&](const auto& values) -> py::object {
            if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::string>) {
                return py::str(values);
            } else if (dataset.shape.empty()) {
                return py::cast(values.at(0));
            } else {
                return view(values.data(), {dataset.shape.begin(), dataset.shape.end()}, owner);
            }
        },
        dataset.values);
}

/// Path below the group of the stage, value, unit and description.
py::tuple entry(const std::string& path, const py::object& value, const std::string& unit, const std::string& description) {
    return py::make_tuple(path, value, unit, description);
}

void append_datasets(py::list& list, const stages::Results& results, std::size_t prefix, const py::object& owner) {
    for (const io::Dataset& dataset : results) {
        list.append(entry(dataset.path.substr(prefix), value_of(dataset, owner), dataset.unit, dataset.description));
    }
}

/// All that a stage found; arrays are views that keep it alive.
py::list entries_of(const py::object& self) {
    const auto& stage = self.cast<const Stage&>();
    const std::size_t prefix = stage.findings.group.size() + 1;
    py::list list;
    append_datasets(list, stage.findings.results, prefix, self);
    append_datasets(list, stage.findings.bond_results, prefix, self);
    for (const io::ParticleField& field : stage.findings.fields) {
        py::array values = rows_of(field.values, self);
        if (field.values.rows() == 1) {
            values = view(field.values.data(), {field.values.cols()}, self);
        }
        list.append(entry("per_particle/" + field.name, values, field.unit, field.description));
    }
    return list;
}

/// Results of a file: path, value, unit, description; arrays are views of what was read.
py::list entries_of_datasets(stages::Results results) {
    auto owned = std::make_unique<stages::Results>(std::move(results));
    const stages::Results& all = *owned;
    const py::capsule owner(owned.release(), [](void* pointer) { delete static_cast<stages::Results*>(pointer); });
    py::list list;
    append_datasets(list, all, 1, owner);
    return list;
}

void define_stage(py::module_& module) {
    py::class_<Stage, std::shared_ptr<Stage>>(module, "Stage")
        .def_property_readonly("group", [](const Stage& stage) { return stage.findings.group; })
        .def_property_readonly("entries", &entries_of)
        .def_property_readonly("notes", [](const Stage& stage) { return stage.findings.notes; })
        .def_property_readonly("table", [](const Stage& stage) { return stage.findings.table; })
        .def_readonly("packing", &Stage::packing)
        .def_readonly("bonds", &Stage::bonds)
        .def_property_readonly("frames",
                               [](const py::object& self) {
                                   py::list frames;
                                   for (const io::Frame& frame : self.cast<const Stage&>().earlier) {
                                       frames.append(py::make_tuple(frame.time, rows_of(frame.positions, self)));
                                   }
                                   return frames;
                               })
        .def_readonly("time", &Stage::time);
}

}  // namespace

void define_values(py::module_& module) {
    define_packing(module);
    define_bonds(module);
    define_stage(module);
    module.def("read_file", [](const std::string& path) {
        io::Contents contents = io::read_contents(path);
        stages::Results results = io::read_results(path, "/generation");
        std::move(contents.results.begin(), contents.results.end(), std::back_inserter(results));
        py::list history;
        for (const io::Provenance& entry : contents.history) {
            history.append(py::dict(py::arg("stage") = entry.stage, py::arg("command_line") = entry.command_line,
                                    py::arg("options") = entry.options, py::arg("seed") = entry.seed,
                                    py::arg("version") = entry.version, py::arg("time") = entry.time,
                                    py::arg("seconds") = entry.seconds, py::arg("positions_sha256") = entry.positions_sha256));
        }
        std::shared_ptr<ContactNetwork> bonds;
        if (contents.structure.bonds) {
            bonds = std::make_shared<ContactNetwork>(std::move(*contents.structure.bonds));
        }
        return py::make_tuple(std::make_shared<Packing>(std::move(contents.structure.packing)), bonds, contents.structure.time,
                              entries_of_datasets(std::move(results)), history);
    });
}

}  // namespace coagula::python
