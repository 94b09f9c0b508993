// Names of simulated results in the cache, and how they are found there.
#pragma once

#include <coagula/diagnose/simulator.hpp>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace coagula::diagnose {

inline std::string key_of(const std::string& what, const std::vector<double>& values) {
    std::ostringstream key;
    key << what;
    key.precision(17);
    for (const double value : values) {
        key << ' ' << value;
    }
    return key.str();
}

/// The result of this key if it has so many numbers; the cache comes from a file, which may have lost some. Otherwise the end.
inline SimulationCache::iterator find_result(SimulationCache& cache, const std::string& key, std::size_t count) {
    const auto found = cache.find(key);
    return found != cache.end() && found->second.size() == count ? found : cache.end();
}

}  // namespace coagula::diagnose
