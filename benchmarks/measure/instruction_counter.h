/// @file instruction_counter.h
/// Instructions that this thread executes: a measure of work that other programs on the machine do not
/// disturb.
#pragma once

namespace fx::cli {

/// Counts in user space, where the system allows it. Threads made before it are not counted.
class InstructionCounter
{
public:
    InstructionCounter();
    ~InstructionCounter();
    InstructionCounter(const InstructionCounter&) = delete;
    InstructionCounter& operator=(const InstructionCounter&) = delete;

    void start();
    double stop(); ///< since start; 0 when the system does not count

private:
    int descriptor_ = -1;
};

} // namespace fx::cli
