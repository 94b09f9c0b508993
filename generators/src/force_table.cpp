#include "force_table.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::generators {

ForceTable::ForceTable(const std::function<double(double)>& force, double first, double last, double spacing)
    : first_(first),
      last_(last),
      inverse_spacing_(1 / spacing),
      intervals_(static_cast<std::size_t>(std::ceil((last - first) / spacing))),
      coefficients_(4 * (intervals_ + 1), 0.0) {
    for (std::size_t interval = 0; interval < intervals_; ++interval) {
        const double left = first + static_cast<double>(interval) * spacing;
        const double right = first + static_cast<double>(interval + 1) * spacing;
        // The right knot belongs to this side of a kink as far as values go: forces are continuous.
        const double a = force(left);
        const double b = force(left + spacing / 3);
        const double c = force(left + 2 * spacing / 3);
        const double d = force(right);
        // Newton's form through 0, 1/3, 2/3, 1, multiplied out.
        double* cubic = &coefficients_[4 * interval];
        cubic[0] = a;
        cubic[1] = 0.5 * (-11 * a + 18 * b - 9 * c + 2 * d);
        cubic[2] = 4.5 * (2 * a - 5 * b + 4 * c - d);
        cubic[3] = 4.5 * (-a + 3 * b - 3 * c + d);
    }
}

double ForceTable::force(double gap) const {
    const double place = (gap - first_) * inverse_spacing_;
    const double inside = std::clamp(place, 0.0, static_cast<double>(intervals_));
    const auto interval = static_cast<std::size_t>(inside);
    const double* cubic = &coefficients_[4 * interval];
    const double t = place - static_cast<double>(interval);
    return cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
}

double smooth_switch(double gap, double start, double end) {
    const double way = std::clamp((gap - start) / (end - start), 0.0, 1.0);
    return 1 - way * way * (3 - 2 * way);
}

}  // namespace coagula::generators
