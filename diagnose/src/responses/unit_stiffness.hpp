#pragma once

namespace coagula::diagnose {

constexpr double unit_stiffness = 100;  ///< of a particle [N/m] in all simulations behind moduli, which are proportional to it

}  // namespace coagula::diagnose
