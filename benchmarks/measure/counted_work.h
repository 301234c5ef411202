/// @file counted_work.h
/// Time and instructions of one piece of work, and nothing around it.
#pragma once

#include <functional>

namespace fx::cli {

struct MeasuredWork
{
    double seconds = 0;      ///< processor time of this thread, which other programs hardly affect
    double instructions = 0; ///< executed in user space, 0 when the system does not count
};

/// Runs `work` on this thread.
MeasuredWork measureWork(const std::function<void()>& work);

} // namespace fx::cli

/// The call that callgrind counts inside of (callgrind.cpp names it); plain C so that its name is
/// the same for every compiler.
extern "C" void fxAccuracyWork(const std::function<void()>* work);
