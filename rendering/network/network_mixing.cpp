#include "rendering/network/network_mixing.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace fx::render {

namespace {

constexpr size_t kMax = 4;

std::vector<float> difference(std::span<const float> a, std::span<const float> b)
{
    std::vector<float> out(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        out[i] = a[i] - b[i];
    return out;
}

} // namespace

void NetworkMixing::clear()
{
    earlier_.clear();
    change_.clear();
    output_.clear();
}

void NetworkMixing::remember(std::span<const float> input, std::span<const float> output,
                             std::span<const float> weight, int depth)
{
    std::vector<float> change = difference(output, input);
    if (!change_.empty() && depth > 0) {
        earlier_.push_back({difference(change, change_), difference(output, output_)});
        while (earlier_.size() > std::min(size_t(depth), kMax))
            earlier_.pop_front();
    }
    change_ = std::move(change);
    output_.assign(output.begin(), output.end());
    weight_.assign(weight.begin(), weight.end());
}

bool NetworkMixing::continues(std::span<const float> output) const
{
    return std::equal(output.begin(), output.end(), output_.begin(), output_.end());
}

double NetworkMixing::product(const std::vector<float>& a, const std::vector<float>& b) const
{
    double sum = 0.0;
    for (size_t first = 0; first < a.size(); first += weight_.size())
        for (size_t i = 0; i < weight_.size(); ++i)
            sum += double(weight_[i]) * double(a[first + i]) * double(b[first + i]);
    return sum;
}

void NetworkMixing::mix(std::span<float> io) const
{
    const size_t n = earlier_.size();
    std::array<std::array<double, kMax + 1>, kMax> rows{}; // (1): equations for c
    for (size_t r = 0; r < n; ++r) {
        for (size_t c = 0; c <= r; ++c)
            rows[r][c] = rows[c][r] = product(earlier_[r].change, earlier_[c].change);
        rows[r][kMax] = product(earlier_[r].change, change_);
    }
    for (size_t r = 0; r < n; ++r)
        rows[r][r] = rows[r][r] * (1.0 + 1e-8) + 1e-300; // (2)
    for (size_t p = 0; p < n; ++p)
        for (size_t r = 0; r < n; ++r) {
            if (r == p || rows[p][p] == 0.0)
                continue;
            const double share = rows[r][p] / rows[p][p];
            for (size_t c = p; c <= kMax; ++c)
                rows[r][c] -= share * rows[p][c];
        }
    for (size_t r = 0; r < n; ++r) {
        const float share = rows[r][r] > 0.0 ? float(rows[r][kMax] / rows[r][r]) : 0.0f;
        for (size_t i = 0; i < io.size(); ++i)
            io[i] -= share * earlier_[r].output[i];
    }
}

} // namespace fx::render
