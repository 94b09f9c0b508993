// SPDX-License-Identifier: GPL-3.0-or-later
// The work on structures of a set, in a process of their own.
#pragma once

#include "set_record.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace coagula::stages {

/// The folder in which a set lies in parts until it is complete: ID.json for each structure that is done or failed, ID.h5 beside
/// it.
class SetParts {
public:
    explicit SetParts(const std::string& set) : folder_(set + ".parts") {}

    const std::filesystem::path& folder() const { return folder_; }
    std::string structure(const std::string& id) const { return (folder_ / (id + ".h5")).string(); }
    /// The record of a structure; nothing where there is none, or one that does not belong to it.
    std::optional<SetRecord> record(const std::string& id) const;
    void keep(const SetRecord& record) const;

private:
    std::filesystem::path folder_;
};

/// Computes rows of one trajectory and keeps them; those that share a generated structure stand together, in the order of their
/// stops. What goes wrong in a structure becomes its record; what goes wrong in keeping it is thrown.
/// @param with_structures whether their files are kept. @return how long the generators took [s].
double compute_rows(const std::vector<const SetRow*>& rows, const SetParts& parts, bool with_structures);

}  // namespace coagula::stages
