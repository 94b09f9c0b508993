// coagula characterize: coordination, pores, degree of heterogeneity and overlaps of a packing.
#include "characterize_results.hpp"
#include "cli/output_file.hpp"
#include "cli/progress_bar.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/spelling.hpp>
#include <coagula/io/structure_file.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace coagula::tools {

namespace {

constexpr std::array measures = {"coordination", "doh", "overlap", "pores"};

std::set<std::string> chosen_measures(const Arguments& arguments) {
    if (!arguments.has("only")) {
        return {measures.begin(), measures.end()};
    }
    std::set<std::string> chosen;
    for (const std::string& name : split(arguments.text("only"))) {
        if (std::find(measures.begin(), measures.end(), name) == measures.end()) {
            throw InputError("--only: '" + name + "' is not one of coordination, doh, overlap, pores" +
                             did_you_mean(name, {"coordination", "doh", "overlap", "pores"}));
        }
        chosen.insert(name);
    }
    return chosen;
}

Characterization measure(const Packing& packing, const Arguments& arguments, const Progress& progress) {
    const std::set<std::string> chosen = chosen_measures(arguments);
    Characterization found;
    found.contact_tolerance = arguments.quantity("contact-tolerance");
    if (chosen.contains("coordination")) {
        found.coordination = characterize::measure_coordination(packing, {.contact_tolerance = found.contact_tolerance});
    }
    if (chosen.contains("overlap")) {
        found.overlaps = characterize::measure_overlaps(packing);
    }
    if (chosen.contains("pores") || chosen.contains("doh") || arguments.has("samples")) {
        found.pores = characterize::measure_pores(packing, {.radii = arguments.count("radii")}, progress);
    }
    if (chosen.contains("doh")) {
        found.heterogeneity = characterize::fit_degree_of_heterogeneity(*found.pores, mean_radius(packing));
    }
    if (arguments.has("samples")) {
        progress.update("sampling", 0.0);
        found.check = compare_with_samples(packing, *found.pores, arguments.count("samples"),
                                           static_cast<std::uint64_t>(arguments.count("seed")));
    }
    return found;
}

void run(const Arguments& arguments) {
    const Stopwatch clock;
    const Progress progress = make_progress(arguments.flag("quiet"));
    chosen_measures(arguments);
    const Packing packing = io::read_structure(arguments.input()).packing;
    const std::string target = checked_target(arguments);

    const Characterization found = measure(packing, arguments, progress);
    const Results results = datasets_of(found, packing);
    check_finite(results);
    progress.update("writing", 1.0);
    io::add_results(arguments.input(), target, {"/characterization"}, std::nullopt, fields_of(found), results,
                    describe_call(arguments, &packing, clock), arguments.flag("force"));

    Json json = to_json(results, "/characterization");
    json["output"] = target;
    json["seconds"] = clock.seconds();
    Table table = table_of(found, packing);
    table.emplace_back("written to", target);
    report(arguments, json, table);
}

}  // namespace

Verb characterize_verb() {
    return {
        .name = "characterize",
        .summary = "coordination number, pore sizes, degree of heterogeneity, overlaps",
        .input = "FILE.h5",
        .options = {quantity("contact-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are in contact", "0.01",
                             within(0, 1)),
                    text("only", "LIST", "measure only these: coordination,doh,overlap,pores"),
                    count("radii", "number of radii of the pore-size curve", "200", within(4, 100000)),
                    count("samples", "also sample N random points, a check of the exact pore-size curve", "", within(100, 1e10)),
                    count("seed", "of the random points", "1", at_least(0)),
                    output("write to a new file; results are added to the input file when not given"),
                    flag("force", "replace an existing output file")},
        .run = run};
}

}  // namespace coagula::tools
