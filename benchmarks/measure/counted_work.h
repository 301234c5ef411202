/// @file counted_work.h
/// Measures time and instructions of one piece of work.
#pragma once

#include <functional>

namespace fx::cli {

struct MeasuredWork
{
    double seconds = 0;      ///< [s] processor time of this thread, hardly affected by other programs
    double instructions = 0; ///< instructions executed in user space; 0 if the system cannot count them
};

/// Runs `work` on this thread and measures it.
MeasuredWork measureWork(const std::function<void()>& work);

} // namespace fx::cli

/// Callgrind counts the instructions inside this call (callgrind.cpp names it). The function has C linkage,
/// so that its name is the same for every compiler.
extern "C" void fxAccuracyWork(const std::function<void()>* work);
