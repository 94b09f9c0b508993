// SPDX-License-Identifier: GPL-3.0-or-later
// report: one page with a view of the structures and all results of their files.

#include <coagula/characterize/largest_pores.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/report/structure_page.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/provenance.hpp>

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

}  // namespace

Printed report_files(const Arguments& arguments) {
    const std::string output = arguments.text("output");
    check_output(arguments, output);
    std::vector<report::PageStructure> pages;
    for (const std::string& path : arguments.inputs()) {
        pages.push_back(read_page(arguments, path));
    }
    tell_apart(pages, arguments.inputs());
    const std::string html = report::structure_page(pages, version_text());
    io::write_file(output, html, arguments.flag("force"));
    const double megabytes = std::round(static_cast<double>(html.size()) / 1e5) / 10;
    return {{{"output", output}, {"structures", pages.size()}, {"bytes", html.size()}},
            {{"structures", std::to_string(pages.size())}, {"size", with_unit(megabytes, "MB")}, {"written to", output}}};
}

Verb report_verb() {
    return {.name = "report",
            .summary = "one page with a view of the structures and all their results, for a browser",
            .input = "FILE.h5",
            .options = {required(output("page to write, such as report.html")),
                        count("pores", "how many of the largest pores can be shown", "50", within(0, 10000)),
                        quantity("contact-tolerance", "1",
                                 "pairs nearer than (1 + this) (r_i + r_j) are drawn as bonds when the file has none", "0.01",
                                 within(0, 1)),
                        flag("force", "replace an existing page")},
            .notes = {"The page opens without a network. Several files are compared side by side."},
            .many_inputs = true};
}

}  // namespace coagula::stages
