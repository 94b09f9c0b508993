#include <coagula/characterize/coordination.hpp>
