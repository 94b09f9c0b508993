// Names of simulated results in the cache.
#pragma once

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

}  // namespace coagula::diagnose
