// SPDX-License-Identifier: GPL-3.0-or-later
// Replicates that agree within groups and differ between them: what they leave over is no noise then.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Groups differ in one of these.
enum class GroupedBy { instrument, day, sample, single_sample };

struct ReplicateGroups {
    GroupedBy by = GroupedBy::sample;
    std::vector<std::string> names;  ///< of the groups; of a single sample beside the others its own
    double between = 0;              ///< rms relative difference in course, beside the level, of tables of different groups
    double within = 0;               ///< the same of tables of one group
    std::string kind;                ///< of the tables
};

/// For tables that were measured alike, three or more: those groups by instrument, day or sample, or of one sample beside the rest,
/// whose tables differ in their course by far more than those of one group. By the ratio of the mean squares of differences between
/// and within groups, in rows that follow each other as closely as those within groups do; by chance in less than one of 10 000.
std::vector<ReplicateGroups> groups_of_replicates(const std::vector<Measurement>& tables);

}  // namespace coagula::diagnose
