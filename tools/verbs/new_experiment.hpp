// An experiment file written from the exports of instruments.
#pragma once

#include "recognised_table.hpp"

#include <string>
#include <vector>

namespace coagula::tools {

/// The commented experiment file. Paths are written relative to `folder`.
std::string new_experiment(const std::vector<RecognisedFile>& files, const std::string& folder);

}  // namespace coagula::tools
