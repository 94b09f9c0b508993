// SPDX-License-Identifier: GPL-3.0-or-later
// The stages: each takes the values of its options, read by the same table as those of the program.
#include "values.hpp"

#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/io/text_formats.hpp>
#include <coagula/io/units.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/diagnose.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/shear.hpp>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace coagula::python {

namespace {

using stages::Arguments;
using stages::Option;
using stages::Verb;
using Options = std::map<std::string, stages::Given>;  ///< by the names of the program
using Words = std::vector<std::string>;

/// What `characterize --compare` does; nothing else goes with it.
Verb comparison() {
    Verb verb = in_memory(stages::characterize_verb(), {"compare", "only", "position-noise", "realizations", "samples"});
    verb.name = "compare heterogeneity";
    verb.summary = "which of two structures is more heterogeneous, by three measures";
    verb.notes.clear();
    return verb;
}

const std::map<std::string, Verb>& verbs() {
    static const std::map<std::string, Verb> all = {
        {"generate_vem", in_memory(stages::generate_vem_verb(), {})},
        {"generate_brownian", in_memory(stages::generate_brownian_verb(), {"start", "potential-curve", "picture"})},
        {"characterize", in_memory(stages::characterize_verb(), {"compare"})},
        {"compare_heterogeneity", comparison()},
        {"shear", in_memory(stages::shear_verb(), {})},
        {"calibrate", in_memory(stages::calibrate_verb(), {})},
        {"fit_power_law", in_memory(stages::fit_power_law_verb(), {"a", "modulus", "standard-error", "modulus-unit"})},
        {"diagnose", stages::diagnose_verb()},
        {"import", stages::import_verb()},
        {"plot", stages::plot_verb()},
        {"report", stages::report_verb()},
    };
    return all;
}

std::string kind_of(const Option& option) {
    switch (option.kind) {
        case Option::Kind::flag:
            return "flag";
        case Option::Kind::count:
            return "count";
        case Option::Kind::quantity:
            return "quantity";
        case Option::Kind::text:
            break;
    }
    return "text";
}

/// The table of options for Python, which makes signatures and documentation of it.
py::dict table_of_verbs() {
    py::dict table;
    for (const auto& [name, verb] : verbs()) {
        py::list options;
        for (const Option& option : verb.options) {
            options.append(py::dict(py::arg("name") = option.name, py::arg("kind") = kind_of(option),
                                    py::arg("placeholder") = option.placeholder, py::arg("meaning") = option.meaning,
                                    py::arg("unit") = option.unit, py::arg("default") = option.fallback,
                                    py::arg("range") = option.range.text(), py::arg("choices") = option.choices,
                                    py::arg("required") = option.required, py::arg("former_name") = option.former_name));
        }
        table[name.c_str()] =
            py::dict(py::arg("summary") = verb.summary, py::arg("options") = options, py::arg("notes") = verb.notes);
    }
    return table;
}

/// @param call as it stands in Python.
Arguments arguments_of(const std::string& verb, const Options& options, const std::string& call = {}) {
    return {verbs().at(verb), {options, call, stages::Caller::python}};
}

std::optional<int> threads_of(const Arguments& arguments) {
    return arguments.has("threads") ? std::optional(static_cast<int>(arguments.count("threads"))) : std::nullopt;
}

template <class Make>
std::shared_ptr<Stage> generated(const Arguments& arguments, const Packing* input, const py::object& progress, const Make& make) {
    const stages::Stopwatch clock;
    stages::Generated made = run(progress, threads_of(arguments), make);
    auto stage = std::make_shared<Stage>();
    stage->generated = true;
    stage->findings = std::move(made.findings);
    stage->packing = std::make_shared<Packing>(std::move(made.structure.packing));
    if (made.structure.bonds) {
        stage->bonds = std::make_shared<ContactNetwork>(std::move(*made.structure.bonds));
    }
    stage->earlier = std::move(made.structure.earlier);
    stage->time = made.structure.time;
    stage->provenance = describe_call(arguments, input, clock, stage->findings.engine);
    return stage;
}

std::shared_ptr<Stage> generate_vem(const Options& options, const std::string& call, const Eigen::VectorXd& radii,
                                    const py::object& progress) {
    const Arguments arguments = arguments_of("generate_vem", options, call);
    return generated(arguments, nullptr, progress,
                     [&](const Progress& told) { return generate(stages::vem_run(arguments, radii), told); });
}

std::shared_ptr<Stage> generate_brownian(const Options& options, const std::string& call, const Eigen::VectorXd& radii,
                                         const std::shared_ptr<Packing>& start, const py::object& progress) {
    const Arguments arguments = arguments_of("generate_brownian", options, call);
    return generated(arguments, start.get(), progress, [&](const Progress& told) {
        return generate(stages::brownian_run(arguments, start.get(), radii), start.get(), told);
    });
}

/// What a structure says about its bonds: the values of its potential by name, or nothing.
std::optional<stages::BondPotential> bonds_of(const std::map<std::string, double>& potential) {
    stages::Results results;
    for (const auto& [name, value] : potential) {
        results.push_back(io::scalar(stages::bond_potential_group + "/" + name, value, "1", ""));
    }
    return stages::bond_potential_in(results);
}

std::shared_ptr<Stage> characterize(const Options& options, const std::string& call, const std::shared_ptr<Packing>& packing,
                                    const std::map<std::string, double>& potential, const py::object& progress) {
    const stages::Stopwatch clock;
    const Arguments arguments = arguments_of("characterize", options, call);
    auto stage = std::make_shared<Stage>();
    stage->findings = run(progress, threads_of(arguments), [&](const Progress& told) {
        return measure(stages::characterize_run(arguments, bonds_of(potential)), *packing, told);
    });
    stage->provenance = describe_call(arguments, packing.get(), clock);
    return stage;
}

std::string compare_heterogeneity(const Options& options, const std::array<std::string, 2>& names,
                                  const std::array<std::shared_ptr<Packing>, 2>& packings, const py::object& progress) {
    const Arguments arguments = arguments_of("compare_heterogeneity", options);
    const std::array<Packing, 2> values = {*packings[0], *packings[1]};
    return run(progress, threads_of(arguments),
               [&](const Progress& told) { return compare(stages::comparison_run(arguments), names, values, told); })
        .json.dump();
}

std::shared_ptr<Stage> shear(const Options& options, const std::string& call, const std::shared_ptr<Packing>& packing,
                             const std::map<std::string, double>& potential, const py::object& progress) {
    const stages::Stopwatch clock;
    const Arguments arguments = arguments_of("shear", options, call);
    stages::Sheared sheared = run(progress, threads_of(arguments), [&](const Progress& told) {
        return stages::shear(stages::shear_run(arguments, {"the structure", bonds_of(potential)}), *packing, told);
    });
    auto stage = std::make_shared<Stage>();
    stage->findings = std::move(sheared.findings);
    stage->bonds = std::make_shared<ContactNetwork>(std::move(sheared.bonds));
    stage->provenance = describe_call(arguments, packing.get(), clock, stage->findings.engine);
    return stage;
}

std::string calibrate(const Options& options, const Words& names, const std::vector<std::shared_ptr<Packing>>& packings,
                      const py::object& progress) {
    const Arguments arguments = arguments_of("calibrate", options);
    std::vector<Packing> values;
    std::transform(packings.begin(), packings.end(), std::back_inserter(values), [](const auto& packing) { return *packing; });
    return run(progress, threads_of(arguments),
               [&](const Progress& told) {
                   return calibrate(stages::calibration_run(arguments, values.size()), names, values, told);
               })
        .printed.json.dump();
}

std::string fit_power_law(const Options& options, const Eigen::VectorXd& a, const Eigen::VectorXd& modulus,
                          const Eigen::VectorXd& standard_error, const py::object& progress) {
    const Arguments arguments = arguments_of("fit_power_law", options);
    return run(progress, threads_of(arguments),
               [&](const Progress& told) {
                   return stages::fit_power_law(stages::power_law_options(arguments), {a, modulus, standard_error}, told);
               })
        .printed.json.dump();
}

std::string diagnose(const Options& options, const std::string& call, const std::string& folder, const py::object& progress) {
    const Arguments arguments = arguments_of("diagnose", options, call);
    return run(progress, threads_of(arguments),
               [&](const Progress& told) { return diagnose_experiment(stages::diagnose_run(arguments, folder), told); })
        .json.dump();
}

py::dict fit_degree_of_heterogeneity(const Eigen::VectorXd& radius, const Eigen::VectorXd& exclusion_probability, double r0) {
    if (radius.size() != exclusion_probability.size() || radius.size() < 2) {
        throw InputError("a pore-size curve needs as many radii as exclusion probabilities, and at least four");
    }
    require_positive(r0, "r0", "m");
    characterize::PoreSizes pores;
    pores.radius = radius;
    pores.exclusion_probability = exclusion_probability;
    // Where the search begins: the area below the curve.
    const Index intervals = radius.size() - 1;
    pores.mean = 0.5 * (radius.tail(intervals) - radius.head(intervals))
                           .dot(exclusion_probability.head(intervals) + exclusion_probability.tail(intervals));
    const auto fit = characterize::fit_degree_of_heterogeneity(pores, r0);
    return py::dict(py::arg("a") = fit.a, py::arg("b") = fit.b, py::arg("a_stderr") = fit.a_stderr,
                    py::arg("b_stderr") = fit.b_stderr, py::arg("rms_residual") = fit.rms_residual);
}

using Write = stages::Printed (*)(const Arguments&);

/// Runs a verb that reads result files and writes a file for people. @return the JSON object that the verb prints.
std::string write_of_files(const std::string& verb, const Options& options, Write write) {
    const Arguments arguments = arguments_of(verb, options);
    return run(py::none(), std::nullopt, [&](const Progress&) { return write(arguments); }).json.dump();
}

/// The table of `coagula info --csv`.
std::vector<Words> table(const Words& paths) {
    return run(py::none(), std::nullopt, [&](const Progress&) { return stages::table_of_files(paths); });
}

/// A file of a structure and of what stages found; each stage is added as the verbs of the program do it.
void write_file(const std::string& path, const std::shared_ptr<Packing>& packing, const std::shared_ptr<ContactNetwork>& bonds,
                const std::vector<std::shared_ptr<Stage>>& stages, const std::string& call, bool overwrite) {
    io::Structure structure{*packing, bonds ? std::optional(*bonds) : std::nullopt};
    io::Provenance history;
    history.stage = "import";
    history.command_line = call;
    history.options = "{}";
    history.version = stages::version_text();
    stages::Results results;
    auto next = stages.begin();
    if (next != stages.end() && (*next)->generated) {
        const Stage& first = **next++;
        history = first.provenance;
        structure.earlier = first.earlier;
        structure.time = first.time;
        results = kept_results(first.findings);
    }
    std::vector<io::Addition> later;
    std::transform(next, stages.end(), std::back_inserter(later), [](const auto& stage) {
        return addition_of(stage->findings, stage->bonds ? std::optional(*stage->bonds) : std::nullopt, stage->provenance);
    });
    io::write_structure(path, structure, {}, results, history, overwrite, later);
}

void export_structure(const std::string& path, const std::shared_ptr<Packing>& packing,
                      const std::shared_ptr<ContactNetwork>& bonds, bool overwrite) {
    stages::export_structure(path, {*packing, bonds ? std::optional(*bonds) : std::nullopt}, overwrite);
}

/// Packing, bonds, time and earlier frames.
py::tuple import_structure(const Options& options) {
    io::Structure structure = stages::import_structure(arguments_of("import", options));
    py::list frames;
    for (const io::Frame& frame : structure.earlier) {
        frames.append(py::make_tuple(frame.time, frame.positions.transpose().eval()));
    }
    std::shared_ptr<ContactNetwork> bonds;
    if (structure.bonds) {
        bonds = std::make_shared<ContactNetwork>(std::move(*structure.bonds));
    }
    return py::make_tuple(std::make_shared<Packing>(std::move(structure.packing)), bonds, structure.time, frames);
}

}  // namespace

void define_stages(py::module_& module) {
    using namespace py::literals;
    module.def("verbs", &table_of_verbs);
    module.def("version", &stages::version_text);
    module.def("parse_quantity", py::overload_cast<const std::string&, const std::string&>(&io::parse_quantity), "text"_a,
               "unit"_a);
    module.def("generate_vem", &generate_vem, "options"_a, "call"_a, "radii"_a, "progress"_a);
    module.def("generate_brownian", &generate_brownian, "options"_a, "call"_a, "radii"_a, "start"_a, "progress"_a);
    module.def("characterize", &characterize, "options"_a, "call"_a, "packing"_a, "potential"_a, "progress"_a);
    module.def("compare_heterogeneity", &compare_heterogeneity, "options"_a, "names"_a, "packings"_a, "progress"_a);
    module.def("shear", &shear, "options"_a, "call"_a, "packing"_a, "potential"_a, "progress"_a);
    module.def("calibrate", &calibrate, "options"_a, "names"_a, "packings"_a, "progress"_a);
    module.def("fit_power_law", &fit_power_law, "options"_a, "a"_a, "modulus"_a, "standard_error"_a, "progress"_a);
    module.def("diagnose", &diagnose, "options"_a, "call"_a, "folder"_a, "progress"_a);
    module.def(
        "plot", [](const Options& options) { return write_of_files("plot", options, stages::plot_files); }, "options"_a);
    module.def(
        "report", [](const Options& options) { return write_of_files("report", options, stages::report_files); }, "options"_a);
    module.def("table", &table, "paths"_a);
    module.def("fit_degree_of_heterogeneity", &fit_degree_of_heterogeneity, "radius"_a, "exclusion_probability"_a, "r0"_a);
    module.def("import_structure", &import_structure, "options"_a);
    module.def("write_file", &write_file, "path"_a, "packing"_a, "bonds"_a, "stages"_a, "call"_a, "overwrite"_a);
    module.def("export_structure", &export_structure, "path"_a, "packing"_a, "bonds"_a, "overwrite"_a);
}

}  // namespace coagula::python
