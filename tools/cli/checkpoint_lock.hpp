// A checkpoint belongs to one run at a time.
#pragma once

#include <string>

namespace coagula::tools {

/// Holds a checkpoint as long as it lives: the hidden file .NAME.lock beside it is locked and removed at the end. What a killed run
/// left of it is taken over. Where the file system has no locks, nothing is held.
class CheckpointLock {
public:
    /// Throws InputError while another run holds it.
    explicit CheckpointLock(const std::string& checkpoint);
    CheckpointLock(const CheckpointLock&) = delete;
    CheckpointLock& operator=(const CheckpointLock&) = delete;
    ~CheckpointLock();

private:
    bool take(const std::string& checkpoint);

    std::string name_;
    int descriptor_ = -1;
};

}  // namespace coagula::tools
