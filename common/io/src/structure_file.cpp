#include <coagula/io/structure_file.hpp>
