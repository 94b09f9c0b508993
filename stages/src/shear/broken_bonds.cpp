// SPDX-License-Identifier: GPL-3.0-or-later
#include "broken_bonds.hpp"

#include <algorithm>
#include <array>

namespace coagula::stages {

namespace {

struct Named {
    BreakageCause cause;
    const char* name;
    const char* meaning;
};
constexpr std::array named{Named{BreakageCause::normal, "normal", "tension"}, Named{BreakageCause::shear, "shear", "shear force"},
                           Named{BreakageCause::bending, "bending", "bending or twisting moment"},
                           Named{BreakageCause::pull_off, "pull_off", "the end of adhesion"}};

}  // namespace

void append_causes(Results& results, const std::string& path, const std::vector<BreakageCause>& causes) {
    results.push_back(io::integer(path + "broken_bonds", static_cast<std::int64_t>(causes.size()), "number of bonds that broke"));
    std::string numbers;
    for (const Named& entry : named) {
        results.push_back(io::integer(path + "broken_by_cause/" + entry.name, std::count(causes.begin(), causes.end(), entry.cause),
                                      std::string("number of bonds that broke by ") + entry.meaning));
        numbers += (numbers.empty() ? "" : ", ") + std::to_string(static_cast<int>(entry.cause)) + " " + entry.name;
    }
    if (!causes.empty()) {
        Eigen::VectorXi cause(static_cast<Eigen::Index>(causes.size()));
        std::transform(causes.begin(), causes.end(), cause.begin(), [](BreakageCause each) { return static_cast<int>(each); });
        results.push_back(io::integers(path + "broken/cause", cause, "limit that each bond reached: " + numbers));
    }
}

}  // namespace coagula::stages
