// The loop of python_loop.py in C++: generates, characterizes and shears structures by the same calls; rows of a CSV on standard
// output, processor time on standard error.
#include <coagula/common/checks.hpp>

#include "cli/verbs.hpp"
#include "verbs/stages.hpp"

#include <ctime>

#include <cstdlib>
#include <iostream>
#include <string>

namespace {

using namespace coagula;

double number(const tools::Findings& found, const std::string& path) {
    for (const io::Dataset& dataset : found.results) {
        if (dataset.path == found.group + "/" + path) {
            return std::get<std::vector<double>>(dataset.values).at(0);
        }
    }
    throw std::runtime_error("no " + path);
}

tools::Verb in_memory(tools::Verb verb) {
    verb.input.clear();
    std::erase_if(verb.options, [](const tools::Option& option) { return option.name == "output"; });
    return verb;
}

void row(const std::string& particles, int seed) {
    const tools::Arguments generate(in_memory(tools::generate_vem_verb()), {"--particles=" + particles, "--volume-fraction=0.4",
                                                                            "--radius=0.25um", "--seed=" + std::to_string(seed)});
    const tools::Generated made = tools::generate_vem(generate, {}, {});
    const Packing& packing = made.structure.packing;
    const tools::Findings measured = tools::characterize_packing({in_memory(tools::characterize_verb()), {}}, packing, {});
    const tools::Sheared sheared = tools::shear_packing({in_memory(tools::shear_verb()), {}}, packing, {});
    std::cout << seed << ',' << to_text(number(measured, "coordination")) << ',' << to_text(number(measured, "doh/a")) << ','
              << to_text(number(sheared.findings, "storage_modulus/mean")) << '\n';
}

}  // namespace

/// bench_python_loop PARTICLES FIRST_SEED STRUCTURES
int main(int argc, char** argv) {
    const std::clock_t begun = std::clock();
    const int first = argc > 2 ? std::atoi(argv[2]) : 1;
    const int structures = argc > 3 ? std::atoi(argv[3]) : 10;
    for (int seed = first; seed < first + structures; ++seed) {
        row(argc > 1 ? argv[1] : "500", seed);
    }
    std::cerr << static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC << '\n';
}
