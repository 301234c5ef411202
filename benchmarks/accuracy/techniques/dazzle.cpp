/// @file dazzle.cpp
/// The dazzle by exact integers, by floating-point sums and by the paper's levels, against real arithmetic.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "foundation/random/philox.h"
#include "rendering/reference/dazzle/dazzle_levels.h"
#include "rendering/reference/dazzle/dazzle_reference.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

constexpr int kWidth = 480, kHeight = 300; // [pixel], the paper's picture
constexpr size_t kPixels = size_t(kWidth) * kHeight;
constexpr size_t kIntegers = 4; // its place among the settings; it does three channels at once

/// Gray in three channels, 1 is white. "explosion": five decades around a bright middle. "gray": one level
/// and few highlights, on which rounding of whole levels shows.
std::vector<float> makePicture(const std::string& scene)
{
    std::vector<float> values;
    for (size_t i = 0; i < kPixels; ++i) {
        const auto u = base::randomUnit4(270, 0, i, base::RandomPurpose::Noise);
        const double x = double(int(i % kWidth) - kWidth / 2) / kHeight,
                     y = double(int(i / kWidth) - kHeight / 2) / kHeight;
        const double fire = 20.0 * std::exp(-60.0 * (x * x + y * y)) * double(0.5f + u[0]);
        const double value =
            scene == "gray" ? (u[0] < 1e-4f ? 31.37 : 0.392) : 0.002 + 0.2 * double(u[1] * u[1]) + fire;
        values.push_back(float(value));
    }
    return values;
}

std::vector<float> rgbaOf(const std::vector<float>& gray)
{
    std::vector<float> rgba;
    for (const float v : gray)
        rgba.insert(rgba.end(), {v, v, v, 1.0f});
    return rgba;
}

std::vector<uint32_t> levelsOf(const std::vector<float>& gray)
{
    std::vector<uint32_t> levels;
    for (const float v : gray)
        levels.push_back(uint32_t(std::lround(double(v) * 255.0)));
    return levels;
}

/// Sums one pixel after the other in T, and moves every pixel towards white.
template <class T>
std::vector<double> bySums(const std::vector<float>& gray)
{
    T over = 0, headroom = 0;
    for (const float v : gray) {
        over += std::max(T(v) - T(1), T(0));
        headroom += std::max(T(1) - T(v), T(0));
    }
    const T share = headroom > T(0) ? std::min(over / headroom, T(1)) : T(0);
    std::vector<double> out;
    out.reserve(gray.size());
    for (const float v : gray)
        out.push_back(double(T(v) < T(1) ? T(v) + (T(1) - T(v)) * share : T(1)));
    return out;
}

class DazzleAccuracy final : public CountedAccuracy
{
public:
    explicit DazzleAccuracy(const std::string& scene)
        : scene_(scene), gray_(makePicture(scene)), rgba_(rgbaOf(gray_)),
          levels_(levelsOf(gray_)), settings_{{"paper8-printed", ""},
                                              {"paper8", "low"},
                                              {"float-sums", ""},
                                              {"double-sums", ""},
                                              {"integers", "default"}}
    {}

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    std::optional<MeasuredWork> work(size_t setting) override
    {
        out_.clear();
        const int times = setting == kIntegers ? 1 : 3; // red, green and blue
        return measureWork([&] {
            for (int k = 0; k < times; ++k)
                out_ = picture(setting);
        });
    }

protected:
    double items() const override { return double(kPixels); }

    void judge(size_t, AccuracySample& outSample) override
    {
        if (reference_.empty())
            reference_ = bySums<long double>(gray_);
        std::vector<double> errors;
        long double light = 0, expected = 0, dealt = 0;
        for (size_t i = 0; i < kPixels; ++i) {
            const float shown = float(out_[i]); // a picture holds floats
            errors.push_back(double(shown) / reference_[i] - 1.0);
            light += static_cast<long double>(shown);
            expected += static_cast<long double>(reference_[i]);
            dealt += std::max(static_cast<long double>(gray_[i]) - 1.0L, 0.0L);
        }
        storeErrors(std::move(errors), outSample);
        outSample.work = {{"pixels", kPixels},
                          {"light_created_per_overflow", double((light - expected) / dealt)}};
    }

private:
    std::vector<double> picture(size_t setting) const
    {
        if (setting == 2)
            return bySums<float>(gray_);
        if (setting == 3)
            return bySums<double>(gray_);
        std::vector<double> out;
        out.reserve(kPixels);
        if (setting == kIntegers) {
            render::DazzleHistory history{};
            const render::DazzleSettings all{.white = 1.0f, .a = 1.0f};
            const auto rgba = render::dazzleReference(rgba_, kWidth, kHeight, all, 0.0, true, history);
            for (size_t i = 0; i < rgba.size(); i += 4)
                out.push_back(double(rgba[i]));
        } else if (setting == 0) {
            for (const int64_t level : render::dazzleLevelsAsPrinted(levels_))
                out.push_back(double(level) / 255.0);
        } else {
            for (const uint8_t level : render::dazzleLevels(levels_, 1.0))
                out.push_back(double(level) / 255.0);
        }
        return out;
    }

    std::string scene_;
    std::vector<float> gray_, rgba_;
    std::vector<uint32_t> levels_;
    std::vector<AccuracySetting> settings_;
    std::vector<double> out_, reference_;
};

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<DazzleAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry dazzleAccuracy()
{
    return {"dazzle",
            "glare by integers, by floating-point sums and by the paper's algorithm",
            "pixel",
            ShownError::P99,
            {"explosion", "gray"},
            2,
            false,
            make};
}

} // namespace fx::cli
