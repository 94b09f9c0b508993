// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/checkpoint_lock.hpp>
#include <coagula/io/structure_file.hpp>

namespace coagula::io {

CheckpointLock::CheckpointLock(const std::string& checkpoint) : place_(checkpoint), lock_(place_, "run") {
    check_output(checkpoint, true);
    if (!lock_.try_take()) {
        throw InputError("another run is using the checkpoint " + checkpoint +
                         ": wait for its end, or give this run a checkpoint of its own");
    }
    if (lock_.was_left()) {
        const OutputFile writing(checkpoint, true);  // removes what the killed run left of its writing
    }
}

}  // namespace coagula::io
