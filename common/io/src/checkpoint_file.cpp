// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/checkpoint_file.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::io {

namespace {

const std::string checksum = "/checksum";

/// Removes the checksum from the datasets; empty when there is none.
std::string take_checksum(std::vector<Dataset>& all) {
    const auto place = std::find_if(all.begin(), all.end(), [](const Dataset& dataset) { return dataset.path == checksum; });
    if (place == all.end() || !std::holds_alternative<std::string>(place->values)) {
        return "";
    }
    std::string sum = std::get<std::string>(place->values);
    all.erase(place);
    return sum;
}

}  // namespace

std::vector<Dataset> checkpoint_head(const std::string& kind, const std::string& signature) {
    return {text("/kind", kind, "what this file is"), text("/signature", signature, "options and structure of the run")};
}

void put(std::vector<Dataset>& all, const std::string& path, Numbers values) {
    const std::size_t count = values.size();
    all.push_back({path, {count}, std::move(values), "1", "state of the run, SI units"});
}

void put(std::vector<Dataset>& all, const std::string& path, Integers values) {
    const std::size_t count = values.size();
    all.push_back({path, {count}, std::move(values), "1", "state of the run"});
}

void write_checkpoint_file(const std::string& path, std::vector<Dataset> all) {
    std::sort(all.begin(), all.end(), [](const Dataset& one, const Dataset& other) { return one.path < other.path; });
    const std::string sum = datasets_sha256(all);
    all.push_back(text(checksum, sum, "SHA-256 of all other values"));
    write_datasets(path, all, true);
}

const Numbers& CheckpointReader::finite(const std::string& name, std::size_t columns, std::size_t rows) const {
    const auto& values = table<Numbers>(name, columns, rows);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
        throw InputError(path_ + ": " + name + " has a value that is not a finite number: the checkpoint is damaged");
    }
    return values;
}

std::int64_t CheckpointReader::whole(std::int64_t value, std::int64_t low, std::int64_t high, const std::string& what) const {
    if (value < low || value >= high) {
        fail("names " + what + " " + std::to_string(value) + ", which does not exist: the checkpoint is damaged");
    }
    return value;
}

CheckpointReader::CheckpointReader(const std::string& path, std::string kind, const std::string& signature)
    : path_(path), kind_(std::move(kind)) {
    std::vector<Dataset> all = read_results(path, "/");
    const std::string stored = take_checksum(all);
    const std::string found = datasets_sha256(all);
    for (Dataset& dataset : all) {
        datasets_.emplace(dataset.path, std::move(dataset));
    }
    if (get<std::string>("/kind") != kind_) {
        fail("is no " + kind_);
    }
    if (stored != found) {
        fail("is damaged: its values do not have the checksum that was written with them; remove it to begin anew");
    }
    if (get<std::string>("/signature") != signature) {
        fail("is the checkpoint of a run with other options or another structure: remove it, or repeat the call that wrote it");
    }
}

}  // namespace coagula::io
