#include "simulation/fragments/fragment_sizes.h"

#include "foundation/math/elementary.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

double mottCoordinate(double size, double mean)
{
    const double ratio = size / mean;
    return std::sqrt(2.0 * ratio * ratio * ratio);
}

double mottSize(const FragmentsDef& def, double u)
{
    const double mean = double(def.meanSize);
    const double most = base::naturalExp(-mottCoordinate(double(def.size.min), mean));
    const double least = base::naturalExp(-mottCoordinate(double(def.size.max), mean));
    const double share = most - u * (most - least);
    if (!(share > 0.0))
        return double(def.size.min); // all wanted sizes lie far above the mean: only the smallest are left
    const double x = -base::naturalLog(share); // (1)
    return mean * base::cubeRoot(0.5 * x * x); // (2)
}

double powerLawSize(const FragmentsDef& def, double u)
{
    const double p = double(def.exponent);
    const double span = base::naturalLog(double(def.size.min) / double(def.size.max));
    const double rest = 1.0 - u * (1.0 - base::naturalExp(p * span));
    return double(def.size.min) * base::naturalExp(-base::naturalLog(rest) / p); // (3)
}

} // namespace

float fragmentSize(const FragmentsDef& def, float u)
{
    const double d = def.sizeLaw == SizeLaw::Mott ? mottSize(def, double(u)) : powerLawSize(def, double(u));
    return std::clamp(float(d), def.size.min, def.size.max);
}

} // namespace fx::sim
