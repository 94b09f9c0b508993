// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/standard_descriptors.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace coagula::io {

void occupy_standard_descriptors() {
    for (const int descriptor : std::array{STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
            open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // gets the lowest number that is free
        }
    }
}

}  // namespace coagula::io
