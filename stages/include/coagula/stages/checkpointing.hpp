// SPDX-License-Identifier: GPL-3.0-or-later
// Where a long run keeps its state.
#pragma once

#include <string>

namespace coagula::stages {

struct Checkpointing {
    std::string path = {};       ///< empty: nowhere
    std::string signature = {};  ///< options and structure, by which runs are told apart

    bool wanted() const { return !path.empty(); }
};

}  // namespace coagula::stages
