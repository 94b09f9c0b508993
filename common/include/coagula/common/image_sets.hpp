// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find on a periodic box, which finds the walks that reach around it.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <numeric>
#include <vector>

namespace coagula {

/// Disjoint sets of points of a periodic box, numbered from 0; each knows the image of the box it lies in relative to that of its
/// root (Machta et al., Phys. Rev. E 54 (1996) 1332).
class ImageSets {
public:
    explicit ImageSets(Eigen::Index members)
        : parent_(static_cast<std::size_t>(members)), size_(parent_.size(), 1), image_(parent_.size(), Image::Zero()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    using Image = Eigen::Vector3i;

    struct Place {
        std::size_t root;
        Image image;
    };

    /// Path halving: every second point on the way is tied to its grandparent.
    Place find(std::size_t point) {
        Image image = Image::Zero();
        while (parent_[point] != point) {
            const std::size_t parent = parent_[point];
            image_[point] += image_[parent];
            parent_[point] = parent_[parent];
            image += image_[point];
            point = parent_[point];
        }
        return {point, image};
    }

    /// Joins two points, the second of which lies `image` boxes from where its coordinates say, seen from the first. Returns
    /// how many boxes a walk around the loop that this closes has moved; zero when it closes none.
    Image join(std::size_t first, std::size_t second, const Image& image) {
        const Place a = find(first);
        const Place b = find(second);
        Image step = a.image + image - b.image;
        if (a.root == b.root) {
            return step;
        }
        if (size_[a.root] >= size_[b.root]) {
            attach(b.root, a.root, step);
        } else {
            attach(a.root, b.root, -step);
        }
        return Image::Zero();
    }

private:
    void attach(std::size_t child, std::size_t root, const Image& image) {
        parent_[child] = root;
        image_[child] = image;
        size_[root] += size_[child];
    }

    std::vector<std::size_t> parent_;
    std::vector<std::size_t> size_;
    std::vector<Image> image_;
};

}  // namespace coagula
