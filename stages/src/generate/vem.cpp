// SPDX-License-Identifier: GPL-3.0-or-later
// generate vem: a packing of chosen heterogeneity by the void expansion method.
#include "size_distribution_text.hpp"

#include <coagula/stages/generate.hpp>

namespace coagula::stages {

namespace {

const std::string vem_group = "/generation/vem/";

Results datasets_of(const generators::VoidExpansion& made, const generators::VoidExpansionOptions& options) {
    const auto number = [](const std::string& name, double value, const std::string& unit, const std::string& description) {
        return io::scalar(vem_group + name, value, unit, description);
    };
    return {
        io::integer(vem_group + "particles", made.packing.size(), "number of particles"),
        io::integer(vem_group + "voids", options.voids, "number of void particles"),
        number("volume_fraction", volume_fraction(made.packing), "1", "solid volume over the volume of the box"),
        io::vector(vem_group + "box", made.packing.cell.lengths(), "m", "edge lengths of the box"),
        number("coordination", made.coordination, "1", "mean number of contacts of a particle, rattlers included"),
        number("target_coordination", options.target_coordination, "1", "mean number of contacts at which the expansion stops"),
        number("contact_tolerance", options.contact_tolerance, "1", "pairs nearer than (1 + tolerance) (r_i + r_j) are in contact"),
        number("overlap/rms", made.overlap_rms, "1", "root mean square overlap of the contacts over the mean diameter"),
        number("overlap/max", made.overlap_max, "1", "largest overlap over the mean diameter"),
        number("void_radius", made.void_radius, "m", "radius of the voids when they were deleted"),
        io::integer(vem_group + "increments", made.increments, "number of increments of the void radius"),
        io::integer(vem_group + "steps", made.steps, "number of explicit time steps"),
        io::integer(vem_group + "seed", static_cast<std::int64_t>(options.seed), "seed of the random numbers")};
}

/// The expansion stops at the first packing that reaches the target. One sentence where that lies well above it, otherwise empty.
std::string overshoot(const generators::VoidExpansion& made, double target) {
    constexpr double close = 0.1;
    return made.coordination - target < close
               ? ""
               : "the coordination number is " + with_unit(made.coordination, "1") + ", well above the target of " +
                     with_unit(target, "1") + "; more particles or another seed come closer";
}

Table table_of(const generators::VoidExpansion& made, const generators::VoidExpansionOptions& options) {
    return {
        {"particles", std::to_string(made.packing.size()) + ", " + std::to_string(options.voids) + " voids"},
        {"box", describe(made.packing.cell)},
        {"volume fraction", with_unit(volume_fraction(made.packing), "1")},
        {"coordination number", with_unit(made.coordination, "1") + ", asked for " + with_unit(options.target_coordination, "1")},
        {"overlap",
         with_unit(100 * made.overlap_rms, "%") + " rms, " + with_unit(100 * made.overlap_max, "%") + " max of the diameter"},
        {"void radius at the end", with_unit(made.void_radius, "m")}};
}

}  // namespace

Results kept_results(const Findings& generated) {
    return generated.group == "/generation/vem" ? Results{} : generated.results;
}

VemRun vem_run(const Arguments& arguments, const Eigen::VectorXd& radii) {
    generators::VoidExpansionOptions options;
    options.seed = static_cast<std::uint64_t>(arguments.count("seed"));
    options.radii = radii_of(arguments, radii, options.seed);
    options.particles = options.radii.size();
    options.voids = arguments.has("voids") ? arguments.count("voids") : options.particles / 2;
    options.volume_fraction = arguments.quantity("volume-fraction");
    options.target_coordination = arguments.quantity("target-coordination");
    options.contact_tolerance = arguments.quantity("contact-tolerance");
    return {std::move(options)};
}

Generated generate(const VemRun& run, const Progress& progress) {
    const generators::VoidExpansionOptions& options = run.expansion;
    generators::VoidExpansion made = generators::expand_voids(options, progress);
    Findings found{.group = "/generation/vem", .results = datasets_of(made, options), .table = table_of(made, options)};
    check_finite(found.results);
    if (const std::string note = overshoot(made, options.target_coordination); !note.empty()) {
        found.notes.push_back(note);
    }
    return {{std::move(made.packing), std::move(made.contacts)}, std::move(found)};
}

Verb generate_vem_verb() {
    return {.name = "generate vem",
            .summary = "make a packing of chosen heterogeneity by void expansion",
            .input = "",
            .options = {
                count("particles", "number of particles", "8000", within(3, 1e8)),
                count("voids",
                      "number of void particles; fewer give a more heterogeneous packing; half of the particles when not given", "",
                      within(0, 1e9)),
                required(quantity("volume-fraction", "1", "volume of the spheres over that of the box", "", between(0, 0.64))),
                particle_radius("mean radius of the particles; required, unless a table gives the radii"),
                reads(text("size-distribution", "NAME",
                           "monodisperse, normal:S, lognormal:S (S = standard deviation over the mean) "
                           "or FILE.csv (columns radius, fraction)",
                           "monodisperse")),
                quantity("target-coordination", "1", "mean number of contacts at which the expansion stops", "4.69", between(0, 6)),
                quantity("contact-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are in contact", "0.01", between(0, 0.1)),
                count("seed", "seed of the random numbers", "1", at_least(0)), required(output("HDF5 file to write")),
                flag("force", "replace an existing file")}};
}

}  // namespace coagula::stages
