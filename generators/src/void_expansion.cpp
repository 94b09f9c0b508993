#include <coagula/generators/void_expansion.hpp>
