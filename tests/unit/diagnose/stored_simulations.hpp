// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of this build have simulated, kept for the tests after them. Linking the test program anew forgets all of it, so
// that no test sees what older code had computed.
#pragma once

#include <coagula/diagnose/simulator.hpp>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ios>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace coagula::diagnose {

class StoredSimulations {
public:
    explicit StoredSimulations(const std::string& name) : path_(std::string(COAGULA_STORED_SIMULATIONS) + "/" + name + ".txt") {
        read();
    }
    StoredSimulations(const StoredSimulations&) = delete;
    StoredSimulations& operator=(const StoredSimulations&) = delete;
    /// Writes what is new beside what other processes have added, under another name first. What cannot be written is made again.
    ~StoredSimulations() {
        try {
            if (results_.size() > found_) {
                read();
                write();
            }
        } catch (const std::exception& error) {
            static_cast<void>(std::fprintf(stderr, "simulations are not stored: %s\n", error.what()));
        }
    }

    SimulationCache& results() { return results_; }

    /// The result of this key, computed where it is not known.
    template <class Compute>
    const std::vector<double>& result(const std::string& key, Compute compute) {
        auto place = results_.find(key);
        if (place == results_.end()) {
            place = results_.emplace(key, compute()).first;
        }
        return place->second;
    }

private:
    /// Lines of key and values in turn; hexadecimal digits keep every bit.
    void read() {
        std::ifstream file(path_);
        for (std::string key, line; std::getline(file, key) && std::getline(file, line);) {
            std::vector<double> values;
            char* end = line.data();
            for (char* begin = end; *begin != '\0'; begin = end) {
                const double value = std::strtod(begin, &end);
                if (end == begin) {
                    throw std::runtime_error(path_.string() + " holds no numbers behind " + key);
                }
                values.push_back(value);
            }
            results_.try_emplace(std::move(key), std::move(values));
        }
        found_ = results_.size();
    }

    void write() const {
        std::filesystem::create_directories(path_.parent_path());
        const std::string other = path_.string() + "." + std::to_string(getpid());
        std::ofstream file(other);
        file << std::hexfloat;
        for (const auto& [key, values] : results_) {
            file << key << '\n';
            for (std::size_t k = 0; k < values.size(); ++k) {
                file << (k > 0 ? " " : "") << values[k];
            }
            file << '\n';
        }
        file.close();
        std::filesystem::rename(other, path_);
    }

    std::filesystem::path path_;
    SimulationCache results_;
    std::size_t found_ = 0;
};

}  // namespace coagula::diagnose
