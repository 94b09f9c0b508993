// SPDX-License-Identifier: GPL-3.0-or-later
// What every fuzz target asks of its reader: a value, or an InputError whose sentence names the file.
#pragma once

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace coagula::fuzz {

/// Ends the program; libFuzzer keeps the input.
[[noreturn]] inline void report(const std::string& finding) {
    std::fprintf(stderr, "coagula fuzz: %s\n", finding.c_str());
    std::abort();
}

inline void expect(bool condition, const std::string& finding) {
    if (!condition) {
        report(finding);
    }
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// A folder for the input: readers take paths. It is removed when the program ends regularly.
class InputFolder {
public:
    InputFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "coagula_fuzz_XXXXXX").string();
        expect(mkdtemp(pattern.data()) != nullptr, "no folder can be made for the input");
        folder_ = pattern;
    }
    ~InputFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    InputFolder(const InputFolder&) = delete;
    InputFolder& operator=(const InputFolder&) = delete;

    /// The path of a file with these contents, which replace those of the last input.
    std::string write(const std::string& name, std::string_view contents) const {
        const std::string path = (folder_ / name).string();
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
        expect(stream.good(), "the input cannot be written to " + path);
        return path;
    }

private:
    std::filesystem::path folder_;
};

/// The path of a file with the input.
inline std::string input_file(const std::uint8_t* data, std::size_t size, const std::string& name) {
    static const InputFolder folder;
    return folder.write(name, text_of(data, size));
}

/// Calls `read`, which checks its value itself. An InputError must name `object`, such as the file; every other exception is a
/// finding, because nobody catches it.
template <class Read>
void expect_value_or_sentence(const std::string& object, Read&& read) {
    try {
        read();
    } catch (const InputError& error) {
        const std::string sentence = error.what();
        expect(sentence.find(object) != std::string::npos, "the sentence '" + sentence + "' does not name " + object);
        expect(sentence.size() > object.size() + 5, "the sentence '" + sentence + "' says nothing");
    }
}

}  // namespace coagula::fuzz
