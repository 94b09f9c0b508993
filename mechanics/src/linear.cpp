#include <coagula/mechanics/linear.hpp>
