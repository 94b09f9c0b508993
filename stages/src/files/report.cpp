// SPDX-License-Identifier: GPL-3.0-or-later
// report: one page with a view of the structures and all results of their files, or of a data set.

#include <coagula/characterize/largest_pores.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/set_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/report/set_page.hpp>
#include <coagula/report/structure_page.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>
#include <coagula/stages/scratch_folder.hpp>

#include <cmath>
#include <filesystem>

namespace coagula::stages {

namespace {

report::PageStructure read_page(const Arguments& arguments, const std::string& path) {
    io::Contents contents = io::read_contents(path);
    report::PageStructure page{.name = std::filesystem::path(path).filename().string(),
                               .structure = std::move(contents.structure),
                               .fields = io::read_results(path, "/VTKHDF/PointData"),
                               .results = std::move(contents.results),
                               .history = std::move(contents.history)};
    const Packing& packing = page.structure.packing;
    if (!page.structure.bonds) {
        page.bonds_in_file = false;
        page.structure.bonds = find_contacts(packing, arguments.quantity("contact-tolerance"));
    }
    if (const std::int64_t count = arguments.count("pores"); count > 0) {
        page.pores = characterize::find_largest_pores(packing, {.count = count});
    }
    return page;
}

/// Files of the same name in different folders are told apart by their paths.
void tell_apart(std::vector<report::PageStructure>& pages, const std::vector<std::string>& paths) {
    for (std::size_t k = 0; k < pages.size(); ++k) {
        for (std::size_t other = 0; other < pages.size(); ++other) {
            if (k != other && std::filesystem::path(paths[k]).filename() == std::filesystem::path(paths[other]).filename()) {
                pages[k].name = paths[k];
            }
        }
    }
}

/// One structure of a set.
report::PageStructure read_from_set(const Arguments& arguments, const std::string& id) {
    const std::string set = arguments.inputs().front();
    if (arguments.inputs().size() > 1) {
        throw InputError(arguments.spelled("structure") + " names a structure of one data set, but " +
                         std::to_string(arguments.inputs().size()) + " files are given");
    }
    if (!io::is_set(set)) {
        throw InputError(set + " is no data set, so that " + arguments.spelled("structure") + " has nothing to choose from");
    }
    const ScratchFolder scratch;
    const std::string file = (scratch.path() / "structure.h5").string();
    io::extract_structure(set, id, file, false);
    report::PageStructure page = read_page(arguments, file);
    page.name = std::filesystem::path(set).filename().string() + ": " + id;
    return page;
}

std::vector<report::PageStructure> structures_for(const Arguments& arguments) {
    if (arguments.has("structure")) {
        return {read_from_set(arguments, arguments.text("structure"))};
    }
    std::vector<report::PageStructure> pages;
    const std::vector<std::string> paths = arguments.inputs();
    for (const std::string& path : paths) {
        if (paths.size() > 1 && io::is_set(path)) {
            throw InputError(path + " is a data set: it has a page of its own, or that of one of its structures by " +
                             arguments.spelled("structure"));
        }
        pages.push_back(read_page(arguments, path));
    }
    tell_apart(pages, paths);
    return pages;
}

Printed written(const Arguments& arguments, const std::string& html, std::size_t structures) {
    const std::string output = arguments.text("output");
    io::write_file(output, html, arguments.flag("force"));
    const double megabytes = std::round(static_cast<double>(html.size()) / 1e5) / 10;
    return {{{"output", output}, {"structures", structures}, {"bytes", html.size()}},
            {{"structures", std::to_string(structures)}, {"size", with_unit(megabytes, "MB")}, {"written to", output}}};
}

}  // namespace

Printed report_files(const Arguments& arguments) {
    check_output(arguments, arguments.text("output"));
    const std::string first = arguments.inputs().front();
    if (!arguments.has("structure") && arguments.inputs().size() == 1 && io::is_set(first)) {
        const report::PageSet set{.name = std::filesystem::path(first).filename().string(),
                                  .head = io::read_set(first),
                                  .holds_structures = !io::structures_in_set(first).empty()};
        const std::size_t rows = set.head.index.empty() ? 0 : set.head.index.front().size();
        return written(arguments, report::set_page(set, version_text()), rows);
    }
    const std::vector<report::PageStructure> pages = structures_for(arguments);
    return written(arguments, report::structure_page(pages, version_text()), pages.size());
}

Verb report_verb() {
    return {.name = "report",
            .summary = "one page with a view of the structures and all their results, or of a data set, for a browser",
            .input = "FILE.h5",
            .options = {required(output("page to write, such as report.html")),
                        count("pores", "how many of the largest pores can be shown", "50", within(0, 10000)),
                        quantity("contact-tolerance", "1",
                                 "pairs nearer than (1 + this) (r_i + r_j) are drawn as bonds when the file has none", "0.01",
                                 within(0, 1)),
                        text("structure", "ID",
                             "of a data set the structure that the page shows; without it the page is that of the set"),
                        flag("force", "replace an existing page")},
            .notes = {"The page opens without a network. Several files are compared side by side.",
                      "The page of a data set has a table that sorts and filters, and figures of any two of its columns."},
            .many_inputs = true};
}

}  // namespace coagula::stages
