// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of python_loop.py in C++: generates, characterizes and shears structures by the same calls; rows of a CSV on standard
// output, processor time on standard error.
#include <coagula/common/checks.hpp>
#include <coagula/stages/characterize.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/shear.hpp>

#include <ctime>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

using namespace coagula;

double number(const stages::Findings& found, const std::string& path) {
    for (const io::Dataset& dataset : found.results) {
        if (dataset.path == found.group + "/" + path) {
            return std::get<std::vector<double>>(dataset.values).at(0);
        }
    }
    throw std::runtime_error("no " + path);
}

void row(std::int64_t particles, std::int64_t seed) {
    const stages::Call call{{{"particles", particles}, {"volume-fraction", 0.4}, {"radius", 0.25e-6}, {"seed", seed}}};
    const stages::Generated made = generate(stages::vem_run({in_memory(stages::generate_vem_verb()), call}), {});
    const Packing& packing = made.structure.packing;
    const stages::CharacterizeRun all = stages::characterize_run({in_memory(stages::characterize_verb()), {}});
    const stages::Findings measured = measure(all, packing, {});
    const stages::Sheared sheared = shear(stages::shear_run({in_memory(stages::shear_verb()), {}}), packing, {});
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
        row(argc > 1 ? std::atoi(argv[1]) : 500, seed);
    }
    std::cerr << static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC << '\n';
}
