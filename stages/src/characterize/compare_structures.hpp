// SPDX-License-Identifier: GPL-3.0-or-later
// The output of `coagula characterize a.h5 b.h5 --compare`.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/characterize/compare.hpp>

#include <array>
#include <string>

namespace coagula::stages {

/// "b.h5 is more heterogeneous by all three measures".
std::string verdict(const characterize::HeterogeneityComparison& comparison, const std::array<std::string, 2>& files);

Json to_json(const characterize::HeterogeneityComparison& comparison, const std::array<std::string, 2>& files);

Table table_of(const characterize::HeterogeneityComparison& comparison, const std::array<std::string, 2>& files);

}  // namespace coagula::stages
