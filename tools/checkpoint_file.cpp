#include "checkpoint_file.hpp"

namespace coagula::tools {

std::vector<io::Dataset> checkpoint_head(const std::string& kind, const std::string& signature) {
    return {io::text("/kind", kind, "what this file is"), io::text("/signature", signature, "options and structure of the run")};
}

void put(std::vector<io::Dataset>& all, const std::string& path, Numbers values) {
    const std::size_t count = values.size();
    all.push_back({path, {count}, std::move(values), "1", "state of the run, SI units"});
}

void put(std::vector<io::Dataset>& all, const std::string& path, Integers values) {
    const std::size_t count = values.size();
    all.push_back({path, {count}, std::move(values), "1", "state of the run"});
}

CheckpointReader::CheckpointReader(const std::string& path, std::string kind, const std::string& signature)
    : path_(path), kind_(std::move(kind)) {
    for (io::Dataset& dataset : io::read_results(path, "/")) {
        datasets_.emplace(dataset.path, std::move(dataset));
    }
    if (get<std::string>("/kind") != kind_) {
        fail("is no " + kind_);
    }
    if (get<std::string>("/signature") != signature) {
        fail("is the checkpoint of a run with other options or another structure: remove it, or repeat the call that wrote it");
    }
}

}  // namespace coagula::tools
