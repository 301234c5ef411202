#include "benchmarks/scenes/detail_shrink.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::cli {

namespace {

constexpr double kCovered = 0.01; ///< [1] opacity from which on a pixel is covered

/// RGBA of each pixel.
using Pixels = std::vector<std::array<double, 4>>;

enum Part : size_t
{
    All,
    Emission, ///< without light from outside
    Sun,
    Sky,
    Count
};
using Parts = std::array<Picture, Count>; ///< of Sun and Sky: with what precedes

base::Result<Parts> draw(const DetailScene& scene, render::ViewSettings settings, int side, double& ioSeconds)
{
    Parts parts;
    const render::Lighting whole = settings.lighting;
    for (const Part part : {All, Emission, Sun}) {
        settings.lighting = whole;
        if (part != All)
            settings.lighting.skyLuminance = glm::vec3(0.0f);
        if (part == Emission)
            settings.lighting.sunIlluminance = glm::vec3(0.0f);
        auto renderer = SnapshotRenderer::create(scene.schema(), settings, side, side);
        if (!renderer.ok())
            return renderer.status();
        const int pictures = part == All ? 2 : 1; // the second one's time counts: the first may compile
        for (int i = 0; i < pictures; ++i)
            if (base::Status status = (*renderer)->render(scene.moment(), scene.camera(), 1.0); !status)
                return status;
        ioSeconds += part == All ? 1e-3 * (*renderer)->millisecondsRender() : 0.0;
        parts[part] = (*renderer)->read().color;
    }
    return parts;
}

/// Light of a part alone, mean of `count` x `count` pixels from the `first` of each square of `size`.
Pixels meanOf(const Parts& parts, Part part, int size, int first, int count)
{
    const int side = parts[All].width / size;
    const auto value = [&](size_t i) {
        const Picture& upper = parts[part == Sky ? All : part];
        double v = double(upper.pixels[i]);
        if (i % 4 != 3 && part == Sun)
            v -= double(parts[Emission].pixels[i]);
        if (i % 4 != 3 && part == Sky)
            v -= double(parts[Sun].pixels[i]);
        return v;
    };
    Pixels pixels(size_t(side) * size_t(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int k = 0; k < count * count; ++k) {
                const size_t row = size_t(size * y + first + k / count);
                const size_t i = row * size_t(parts[All].width) + size_t(size * x + first + k % count);
                for (size_t c = 0; c < 4; ++c)
                    pixels[size_t(y) * size_t(side) + size_t(x)][c] += value(4 * i + c) / (count * count);
            }
    return pixels;
}

/// Root mean square over the covered pixels. @param first, last channels
double rms(const Pixels& a, const Pixels* less, const Pixels& mask, size_t first, size_t last)
{
    double squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t c = first; c <= last && mask[i][3] >= kCovered; ++c, ++count) {
            const double difference = a[i][c] - (less ? (*less)[i][c] : 0.0);
            squares += difference * difference;
        }
    return std::sqrt(squares / double(std::max<size_t>(count, 1)));
}

} // namespace

base::Result<ShrinkErrors> shrinkErrors(const DetailScene& scene, const render::ViewSettings& settings,
                                        int side, double& ioSeconds)
{
    const auto large = draw(scene, settings, kShrink * side, ioSeconds);
    if (!large.ok())
        return large.status();
    const auto small = draw(scene, settings, side, ioSeconds);
    if (!small.ok())
        return small.status();
    const Pixels want = meanOf(*large, All, kShrink, 0, kShrink);
    const Pixels middle = meanOf(*large, All, kShrink, kShrink / 2 - 1, 2);
    const Pixels got = meanOf(*small, All, 1, 0, 1);
    const double scale = std::max(rms(want, nullptr, want, 0, 2), 1e-30);
    const double opacity = std::max(rms(want, nullptr, want, 3, 3), 1e-30);
    ShrinkErrors errors;
    double sums[2] = {};
    for (size_t i = 0; i < want.size(); ++i)
        for (size_t c = 0; c < 3 && want[i][3] >= kCovered; ++c) {
            errors.values.push_back((got[i][c] - want[i][c]) / scale);
            sums[0] += want[i][c];
            sums[1] += got[i][c];
        }
    errors.bias = sums[1] / std::max(sums[0], 1e-30) - 1.0;
    errors.light = rms(got, &want, want, 0, 2) / scale;
    errors.transmittance = rms(got, &want, want, 3, 3) / opacity;
    errors.unfaded = rms(middle, &want, want, 0, 2) / scale;
    errors.unfadedTransmittance = rms(middle, &want, want, 3, 3) / opacity;
    const auto partError = [&](Part part) {
        const Pixels wanted = meanOf(*large, part, kShrink, 0, kShrink);
        return rms(meanOf(*small, part, 1, 0, 1), &wanted, want, 0, 2) / scale;
    };
    errors.emission = partError(Emission);
    errors.sun = partError(Sun);
    errors.sky = partError(Sky);
    return errors;
}

} // namespace fx::cli
