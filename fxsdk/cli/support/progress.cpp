#include "fxsdk/cli/support/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace fx::cli {
namespace {

constexpr int kBarWidth = 24; // [character]

std::string durationText(double seconds)
{
    const long whole = std::lround(std::ceil(seconds));
    if (whole < 120)
        return std::to_string(whole) + " s";
    return std::to_string((whole + 59) / 60) + " min";
}

} // namespace

std::string progressText(const std::string& what, uint64_t done, uint64_t total, double elapsedSeconds)
{
    const double share = total == 0 ? 1.0 : std::min(1.0, double(done) / double(total));
    const int filled = int(share * kBarWidth);
    std::string text = what + " " + std::to_string(done) + "/" + std::to_string(total) + " [";
    text.append(size_t(filled), '#').append(size_t(kBarWidth - filled), ' ');
    text += "] " + std::to_string(int(share * 100.0)) + " %";
    if (done > 0 && done < total)
        text.append(" ").append(durationText(elapsedSeconds * (1.0 - share) / share)).append(" left");
    return text;
}

Progress::Progress(std::string what, uint64_t total, bool enabled)
    : what_(std::move(what)), total_(total), enabled_(enabled && isatty(STDERR_FILENO) == 1)
{}

Progress::~Progress()
{
    if (drawn_)
        std::fputs("\r\033[K", stderr);
}

void Progress::update(uint64_t done)
{
    const Clock::time_point now = Clock::now();
    if (!enabled_ || (drawn_ && now - lastDrawn_ < std::chrono::milliseconds(100)))
        return;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    std::fprintf(stderr, "\r\033[K%s", progressText(what_, done, total_, elapsed).c_str());
    std::fflush(stderr);
    drawn_ = true;
    lastDrawn_ = now;
}

} // namespace fx::cli
