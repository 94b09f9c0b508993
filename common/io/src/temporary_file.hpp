// SPDX-License-Identifier: GPL-3.0-or-later
// A hidden file that becomes another one when it is complete.
#pragma once

#include <coagula/io/output_place.hpp>
#include <coagula/io/unfinished_file.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace coagula::io {

/// A new file beside the one at `place`, under a name that nobody can foresee (.NAME.<random>.tmp). It is removed again unless it
/// was renamed. All functions throw as OutputPlace::fail does.
class TemporaryFile {
public:
    /// Bytes by which its name is longer than that of the file.
    static constexpr std::size_t longer_by = 18;

    explicit TemporaryFile(const OutputPlace& place);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    /// For reading and writing.
    int descriptor() const { return descriptor_; }
    void write(std::span<const char> bytes);
    /// Leaves so many bytes, and brings them to the disk.
    void finish(std::size_t size);
    /// The file that is replaced gives it its mode and, as far as allowed, its owner.
    void keep_owner_and_mode();
    /// Brings the bytes to the disk, and reads them back.
    void sync(std::span<const char> bytes);
    /// Takes the place of the file. Throws InputError where one is there and must not be replaced.
    void rename(bool overwrite);
    /// Removes what killed writers to `place` left; only whoever holds the lock of `place` may.
    static void remove_leftovers(const OutputPlace& place);

private:
    bool make(mode_t mode);
    bool rename_to_new() const;

    const OutputPlace& place_;
    std::string name_;
    int descriptor_ = -1;
    std::optional<UnfinishedFile> unfinished_;  ///< until it is renamed
};

}  // namespace coagula::io
