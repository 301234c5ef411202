/// @file progress.h
/// A progress bar with the remaining time on standard error, if standard error is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace fx::cli {

/// The bar's text: "frame 12/60 [##### ] 20 % 8 s left". The function has no side effects.
/// @param done parts finished, 0..total
/// @param elapsedSeconds [s] since the start; the remaining time assumes that all parts take equally long
std::string progressText(const std::string& what, uint64_t done, uint64_t total, double elapsedSeconds);

class Progress
{
public:
    /// Creates a progress bar.
    /// @param enabled false: nothing is printed, even on a terminal
    Progress(std::string what, uint64_t total, bool enabled);
    ~Progress(); ///< erases the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Redraws at most ten times a second.
    void update(uint64_t done);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    uint64_t total_;
    bool enabled_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastDrawn_;
};

} // namespace fx::cli
