// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/checksums.hpp>
#include <coagula/io/structure_file.hpp>

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "layout.hpp"
#include "packed.hpp"

namespace coagula::io {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
        throw std::runtime_error("OpenSSL cannot compute a SHA-256");
    }
    const char* digits = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
        text += digits[digest[i] >> 4];
        text += digits[digest[i] & 15];
    }
    return text;
}

std::string positions_sha256(const Packing& packing) {
    const Eigen::Matrix3Xd positions = layout::stored_positions(packing);
    return sha256({reinterpret_cast<const char*>(positions.data()), static_cast<std::size_t>(positions.size()) * sizeof(double)});
}

std::string datasets_sha256(const std::vector<Dataset>& datasets) {
    Packer packer;
    for (const Dataset& dataset : datasets) {
        packer(dataset.path, dataset.values);
    }
    return sha256(packer.take());
}

}  // namespace coagula::io
