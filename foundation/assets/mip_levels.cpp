#include "foundation/assets/mip_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace fx::base {

namespace {

constexpr size_t kCodes = 4096; ///< steps of the table from light to sRGB: half a code of error at most

float lightOf(float code)
{
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

float codeOf(float light)
{
    return light <= 0.0031308f ? light * 12.92f : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
}

/// Codes to light, and the square root of light to codes, where the curve is nearly straight.
struct Tables
{
    std::array<float, 256> light;
    std::array<uint8_t, kCodes + 1> code;

    Tables()
    {
        for (size_t i = 0; i < light.size(); ++i)
            light[i] = lightOf(float(i) / 255.0f);
        for (size_t i = 0; i <= kCodes; ++i) {
            const float root = float(i) / float(kCodes);
            code[i] = uint8_t(std::lround(255.0f * codeOf(root * root)));
        }
    }
};

} // namespace

int mipLevelCount(int width, int height)
{
    return int(std::bit_width(unsigned(std::max({width, height, 1}))));
}

void halveImage(std::span<const uint8_t> rgba, int width, int height, bool isSrgb, std::vector<uint8_t>& out)
{
    static const Tables tables;
    const int w = std::max(width / 2, 1);
    const int h = std::max(height / 2, 1);
    out.resize(size_t(w) * size_t(h) * 4);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            std::array<float, 3> color{};
            std::array<float, 3> bare{}; // where all is transparent there is nothing else to go by
            float weight = 0.0f;
            float opacity = 0.0f;
            float count = 0.0f;
            for (int sy = y * height / h; sy < (y + 1) * height / h; ++sy)
                for (int sx = x * width / w; sx < (x + 1) * width / w; ++sx) {
                    const uint8_t* texel = &rgba[(size_t(sy) * size_t(width) + size_t(sx)) * 4];
                    const float share = isSrgb ? float(texel[3]) : 1.0f;
                    for (size_t k = 0; k < 3; ++k) {
                        const float value = isSrgb ? tables.light[texel[k]] : float(texel[k]);
                        color[k] += share * value;
                        bare[k] += value;
                    }
                    weight += share;
                    opacity += float(texel[3]);
                    count += 1.0f;
                }
            uint8_t* target = &out[(size_t(y) * size_t(w) + size_t(x)) * 4];
            for (size_t k = 0; k < 3; ++k) {
                const float mean = weight > 0.0f ? color[k] / weight : bare[k] / count;
                target[k] = isSrgb ? tables.code[size_t(std::lround(std::sqrt(mean) * float(kCodes)))]
                                   : uint8_t(std::lround(mean));
            }
            target[3] = uint8_t(std::lround(opacity / count));
        }
}

} // namespace fx::base
