#include "rendering/network/scattering_network.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr size_t kBlock = 1024; // cells whose moments are summed at once

} // namespace

void ScatteringNetwork::findSources(const std::vector<float>& light, base::TaskRunner& tasks)
{
    source_.resize(light.size());
    const float unit = float(std::sqrt(4.0 * std::numbers::pi));
    tasks.parallelFor(uint32_t(count()), uint32_t(kBlock), [&](uint32_t begin, uint32_t end) {
        for (size_t k = 0; k < size_t(moments_); ++k) {
            const float factor = float(phase_.factors[size_t(harmonicBand(int(k)))]);
            const size_t first = k * count();
            for (size_t i = begin; i < end; ++i)
                source_[first + i] = factor * scattering_[i] * (light[first + i] + direct_[first + i]); // (1)
        }
        for (size_t i = begin; i < end; ++i)
            source_[i] += unit * emission_[i];
    });
}

template <int Moments>
void ScatteringNetwork::followLines(base::TaskRunner& tasks)
{
    radiance_.resize(directions_.size() * count());
    planes_.resize(directions_.size());
    ends_.assign(directions_.size(), {});
    tasks.parallelFor(uint32_t(directions_.size()), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t d = begin; d < end; ++d)
            followDirection<Moments>(d);
    });
}

template void ScatteringNetwork::followLines<4>(base::TaskRunner&);
template void ScatteringNetwork::followLines<9>(base::TaskRunner&);

/// Slice after slice across z, or across y where lines stay in a slice of z. Rows of x have a cell more at
/// each end and slices a row, through which light enters.
template <int Moments>
void ScatteringNetwork::followDirection(size_t d)
{
    const glm::ivec3 step = directions_[d].step, cells = grid_.cells;
    if (step.y == 0 && step.z == 0)
        return followAlongX<Moments>(d);
    const bool isAcrossZ = step.z != 0;
    const size_t pitch = size_t(cells.x) + 2;
    const size_t plane = pitch * (isAcrossZ ? size_t(cells.y) + 2 : 1);
    const int slices = isAcrossZ ? cells.z : cells.y, forward = isAcrossZ ? step.z : step.y;
    std::vector<float>& planes = planes_[d];
    for (int group = 0; group < (isAcrossZ ? 1 : cells.z); ++group) {
        planes.assign(2 * plane, environment_[d]);
        for (int t = 0; t < slices; ++t) {
            const int slice = forward > 0 ? t : slices - 1 - t;
            const float* before = planes.data() + (t & 1 ? plane : 0);
            float* after = planes.data() + (t & 1 ? 0 : plane);
            for (int row = 0; row < (isAcrossZ ? cells.y : 1); ++row) {
                const glm::ivec3 first = isAcrossZ ? glm::ivec3(0, row, slice) : glm::ivec3(0, slice, group);
                const size_t from = isAcrossZ ? size_t(row + 1 - step.y) * pitch : 0;
                float* out = after + (isAcrossZ ? size_t(row + 1) * pitch : 0) + 1;
                followRow<Moments>(d, grid_.index(first), before + from + 1 - step.x, out);
                countEnds(d, first, out);
            }
        }
    }
}

/// Cells of a row from the light before each of them.
template <int Moments>
void ScatteringNetwork::followRow(size_t d, size_t first, const float* in, float* out)
{
    const size_t way = size_t(directions_[d].squares - 1);
    const float* __restrict taken = taken_[way].data() + first;
    const float* __restrict mean = mean_[way].data() + first;
    const float* __restrict source = source_.data() + first;
    const float* __restrict before = in;
    float* __restrict radiance = radiance_.data() + d * count() + first;
    float* __restrict after = out;
    const auto y = harmonics_[d];
    const size_t pitch = count();
    for (int x = 0; x < grid_.cells.x; ++x) {
        float s = 0.0f;
        for (size_t k = 0; k < Moments; ++k)
            s += source[k * pitch + size_t(x)] * y[k];
        const float more = s - before[x];
        after[x] = std::max(before[x] + taken[x] * more, 0.0f);   // (2)
        radiance[x] = std::max(before[x] + mean[x] * more, 0.0f); // (2)
    }
}

template <int Moments>
void ScatteringNetwork::followAlongX(size_t d)
{
    const bool isForward = directions_[d].step.x > 0;
    const auto y = harmonics_[d];
    std::vector<float>& row = planes_[d];
    row.resize(size_t(grid_.cells.x));
    for (size_t first = 0; first < count(); first += size_t(grid_.cells.x)) {
        float light = environment_[d];
        for (int t = 0; t < grid_.cells.x; ++t) {
            const size_t x = size_t(isForward ? t : grid_.cells.x - 1 - t), i = first + x;
            float s = 0.0f;
            for (size_t k = 0; k < Moments; ++k)
                s += source_[k * count() + i] * y[k];
            const float more = s - light;
            radiance_[d * count() + i] = std::max(light + mean_[0][i] * more, 0.0f); // (2)
            light = std::max(light + taken_[0][i] * more, 0.0f);                     // (2)
            row[x] = light;
        }
        ends_[d].entering += double(environment_[d]);
        ends_[d].leaving += double(light);
    }
}

/// Lines of a row that begin or end in it.
void ScatteringNetwork::countEnds(size_t d, const glm::ivec3& row, const float* out)
{
    const glm::ivec3 step = directions_[d].step, last = grid_.cells - 1;
    const auto isOutside = [&](int y, int z) { return y < 0 || z < 0 || y > last.y || z > last.z; };
    const int across = step.x != 0 ? 1 : 0;
    const bool allEnter = isOutside(row.y - step.y, row.z - step.z);
    ends_[d].entering += double(environment_[d]) * double(allEnter ? grid_.cells.x : across);
    if (isOutside(row.y + step.y, row.z + step.z))
        for (int x = 0; x <= last.x; ++x)
            ends_[d].leaving += double(out[x]);
    else if (across != 0)
        ends_[d].leaving += double(out[step.x > 0 ? last.x : 0]);
}

void ScatteringNetwork::sumMoments(base::TaskRunner& tasks)
{
    next_.resize(size_t(moments_) * count());
    const uint32_t blocks = uint32_t((count() + kBlock - 1) / kBlock);
    tasks.parallelFor(blocks, 1, [&](uint32_t firstBlock, uint32_t lastBlock) {
        for (size_t b = firstBlock; b < lastBlock; ++b) {
            const size_t begin = b * kBlock, end = std::min(begin + kBlock, count());
            for (size_t k = 0; k < size_t(moments_); ++k) {
                float* sum = next_.data() + k * count();
                std::fill(sum + begin, sum + end, 0.0f);
                for (size_t d = 0; d < directions_.size(); ++d) {
                    const float share = float(directions_[d].weight * double(harmonics_[d][k]));
                    const float* radiance = radiance_.data() + d * count();
                    for (size_t i = begin; i < end; ++i)
                        sum[i] += share * radiance[i]; // (3)
                }
            }
        }
    });
}

} // namespace fx::render
