/// @file instruction_counter.h
/// Counts the instructions that this thread executes, a measure of work that other programs do not affect.
#pragma once

namespace fx::cli {

/// Counts the instructions of the calling thread in user space, if the system allows it. Threads created
/// before the counter are not counted.
class InstructionCounter
{
public:
    InstructionCounter();
    ~InstructionCounter();
    InstructionCounter(const InstructionCounter&) = delete;
    InstructionCounter& operator=(const InstructionCounter&) = delete;

    void start();
    double stop(); ///< instructions since start(); 0 if the system cannot count them

private:
    int descriptor_ = -1;
};

} // namespace fx::cli
