#include "checkpoint_lock.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/structure_file.hpp>

namespace coagula::tools {

CheckpointLock::CheckpointLock(const std::string& checkpoint) : place_(checkpoint), lock_(place_, "run") {
    io::check_output(checkpoint, true);
    if (!lock_.try_take()) {
        throw InputError("another run is using the checkpoint " + checkpoint +
                         ": wait for its end, or give this run a checkpoint of its own");
    }
    if (lock_.was_left()) {
        const io::OutputFile writing(checkpoint, true);  // removes what the killed run left of its writing
    }
}

}  // namespace coagula::tools
