// SPDX-License-Identifier: GPL-3.0-or-later
#include "reader_contract.hpp"

#include <coagula/experiment/simulation_cache.hpp>

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "simulations.txt");
    fuzz::expect_value_or_sentence(path, [&] {
        const diagnose::SimulationCache cache = experiment::read_cache(path);
        for (const auto& [key, values] : cache) {
            fuzz::expect(!values.empty(), "the result " + key + " has no numbers");
            fuzz::expect(std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }),
                         "the result " + key + " is not finite");
        }
        const fuzz::InputFolder folder;
        fuzz::expect(experiment::read_cache(folder.write("simulations.txt", experiment::cache_text(cache))) == cache,
                     "what is written of the cache is not what was read");
    });
    return 0;
}
