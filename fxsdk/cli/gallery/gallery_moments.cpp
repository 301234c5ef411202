#include "fxsdk/cli/gallery/gallery_moments.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {

std::vector<base::Ticks> stripMoments(double time, double duration, int count)
{
    constexpr double kApart = 1.0 / 60.0;    // [s] moments closer than that show the same
    constexpr double kShownOfDuration = 0.6; // [1]
    const double first = 0.5 * std::max(time, kApart);
    const double wanted = duration > 0.0 ? kShownOfDuration * duration : 4.0 * time;
    const double last =
        std::max(std::min(wanted, kGalleryEnd), std::max(time, first + kApart * double(count)));
    std::vector<base::Ticks> moments;
    for (int i = 0; i < count; ++i) {
        const double share = count == 1 ? 0.5 : double(i) / double(count - 1);
        moments.push_back(base::toTicks(first * std::pow(last / first, share)));
    }
    return moments;
}

} // namespace fx::cli
