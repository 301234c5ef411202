#include "rendering/image/image_metrics.h"

#include "foundation/math/bits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::image {

namespace {

double distance(float a, float b)
{
    if (base::isFinite(a) && base::isFinite(b))
        return std::abs(double(a) - double(b));
    const bool isSame = a == b || (a != a && b != b);
    return isSame ? 0.0 : std::numeric_limits<double>::infinity();
}

} // namespace

base::Result<Difference> compare(const Image& a, const Image& b)
{
    if (a.width != b.width || a.height != b.height || a.channels != b.channels ||
        a.pixels.size() != b.pixels.size())
        return base::Status(base::Code::InvalidArgument, "pictures of different sizes cannot be compared");
    Difference difference;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = distance(a.pixels[i], b.pixels[i]);
        difference.max = std::max(difference.max, d);
        difference.mean += d;
        difference.rms += d * d;
    }
    const double count = double(std::max<size_t>(a.pixels.size(), 1));
    difference.mean /= count;
    difference.rms = std::sqrt(difference.rms / count);
    return difference;
}

} // namespace fx::image
