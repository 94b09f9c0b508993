#include <coagula/common/cell.hpp>
#include <coagula/common/checks.hpp>

namespace coagula {

// NOLINTNEXTLINE(modernize-pass-by-value): three numbers move no faster than they copy
Cell::Cell(const Eigen::Vector3d& origin, const Eigen::Vector3d& lengths, bool periodic)
    : edges_(lengths.asDiagonal()), inverse_lengths_(lengths.cwiseInverse()), origin_(origin), periodic_(periodic) {
    for (const double length : lengths) {
        require_positive(length, "the edge length of the box", "m");
    }
    require_positive(volume(), "the volume of the box", "m^3");
}

Cell Cell::periodic(const Eigen::Vector3d& lengths) {
    return {Eigen::Vector3d::Zero(), lengths, true};
}

Cell Cell::open(const Eigen::Vector3d& lower, const Eigen::Vector3d& lengths) {
    return {lower, lengths, false};
}

Eigen::Vector3d Cell::wrap(const Eigen::Vector3d& position) const {
    if (!periodic_) {
        return position;
    }
    Eigen::Vector3d wrapped = position;
    for (int axis = 0; axis < 3; ++axis) {
        const double length = edges_(axis, axis);
        double offset = wrapped[axis] - origin_[axis];
        offset -= length * std::floor(offset * inverse_lengths_[axis]);
        wrapped[axis] = origin_[axis] + (offset >= length || offset < 0 ? 0.0 : offset);
    }
    return wrapped;
}

}  // namespace coagula
