#include "rendering/blocks/block_errors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr uint64_t kWorkOfFrame = 1 << 21; ///< of predictions, about
constexpr size_t kMostEntries = 4096;
constexpr uint64_t kUnusedFrames = 240;

/// [1] Errors are predicted from few rays.
constexpr float kSafety = 1.2f;
/// [1] Standard deviations of the mean square of as many rays as a block has pixels, or fewer.
constexpr float kDeviations = 6.0f;
/// [rad] about the largest difference of directions in the finest cell
constexpr float kFinestAngle = 4.2f / float(kMaxDirectionCells);

float squareOf(float x)
{
    return x * x;
}

ErrorPart mixed(const ErrorPart& a, const ErrorPart& b, float t)
{
    return {glm::mix(a.rms, b.rms, t), glm::mix(a.tail, b.tail, t)};
}

TileError mixed(const TileError& a, const TileError& b, float t)
{
    TileError out;
    for (size_t i = 0; i < kTileSizes; ++i)
        out.texels[i] = mixed(a.texels[i], b.texels[i], t);
    out.shift = mixed(a.shift, b.shift, t);
    out.albedo = mixed(a.albedo, b.albedo, t);
    out.light = mixed(a.light, b.light, t);
    out.covered = glm::mix(a.covered, b.covered, t);
    out.rays = glm::mix(a.rays, b.rays, t);
    return out;
}

} // namespace

TileError errorAt(const TileErrors& errors, float density)
{
    const auto& of = errors.ofPowers;
    const float power = std::log2(std::max(density, 1e-20f)) - float(errors.lowest);
    const auto scaled = [](const TileError& error, float factor) {
        TileError none;
        none.covered = error.covered;
        none.rays = error.rays;
        return mixed(none, error, factor);
    };
    if (power <= 0.0f)
        return scaled(of.front(), std::exp2(power));
    if (const float beyond = power - float(of.size() - 1); beyond >= 0.0f)
        return scaled(of.back(), std::exp2(std::min(beyond, 40.0f)));
    const auto below = std::min(size_t(power), of.size() - 2);
    return mixed(of[below], of[below + 1], power - float(below));
}

TileErrors errorsBetween(const TileErrors& a, const TileErrors& b, float t)
{
    TileErrors out;
    out.lowest = b.lowest;
    for (size_t i = 0; i < out.ofPowers.size(); ++i)
        out.ofPowers[i] = mixed(errorAt(a, std::exp2(float(b.lowest + int(i)))), b.ofPowers[i], t);
    return out;
}

TileSource sourceOf(const BlockContent& content, float exposure)
{
    // How media will be lit is not known: they count as white where they scatter everything.
    const glm::vec3 value = exposure * content.light + content.albedo;
    return {exposure, float(std::sqrt(glm::dot(value, value) / 3.0f))};
}

TileChoice chooseTile(const TileError& error, const TileSource& source, const TileView& view, float limit)
{
    const float pixels =
        std::max(0.25f * std::numbers::pi_v<float> * squareOf(view.pixels) * error.covered, 1.0f);
    const float ofTail = kDeviations / std::sqrt(std::min(pixels, error.rays));
    const auto of = [&](const ErrorPart& part) {
        return std::sqrt(squareOf(part.rms) + ofTail * squareOf(part.tail));
    };
    // Tiles of near blocks are wider, and errors of interpolation proportional to the square of a texel.
    const float wider = 1.0f / (1.0f - squareOf(std::min(view.nearness, kMaxNearness)));
    const float color = source.exposure * of(error.light) + of(error.albedo);
    const float shift = source.value * of(error.shift);
    const float most = squareOf(limit / kSafety);
    const auto ofTexels = [&](size_t size) {
        return squareOf(color) + squareOf(source.value * wider * of(error.texels[size]));
    };
    size_t finest = kTileSizes - 1;
    while (finest > 0 && kMinTile << finest > view.finest)
        --finest;
    TileChoice choice;
    choice.least = kSafety * std::sqrt(ofTexels(finest) + squareOf(shift * kFinestAngle));
    size_t size = 0;
    while (size < finest && ofTexels(size) > 0.5f * most)
        ++size;
    choice.texels = kMinTile << size;
    const float rest = std::sqrt(std::max(most - ofTexels(size), 0.0f));
    choice.angle = std::max(rest / std::max(shift, 1e-6f), kFinestAngle);
    return choice;
}

void BlockErrors::begin(bool isSpread)
{
    isSpread_ = isSpread;
    ++frame_;
    work_ = 0;
    deferred_ = 0;
    wasNewLeft_ = isNewLeft_;
    isNewLeft_ = false;
    oldestLeftBefore_ = oldestLeft_;
    oldestLeft_ = 0;
    if (entries_.size() > kMostEntries)
        std::erase_if(entries_,
                      [&](const auto& entry) { return entry.second.frame + kUnusedFrames < frame_; });
}

void BlockErrors::forget()
{
    entries_.clear();
    balls_ = std::pmr::vector<BlockBall>(balls_.get_allocator());
}

/// Whether a content that is due is predicted in this frame. What waits is counted.
bool BlockErrors::canPredict(const Entry* known)
{
    if (!isSpread_)
        return true;
    bool can = work_ <= kWorkOfFrame;
    if (known) {
        // Effects are visited in the same order in each frame, which must not be that of predictions.
        const uint64_t age = frame_ - known->made;
        can = can && !wasNewLeft_ && 4 * age >= 3 * oldestLeftBefore_;
        if (!can)
            oldestLeft_ = std::max(oldestLeft_, age);
    } else if (!can) {
        isNewLeft_ = true;
    }
    deferred_ += can ? 0 : 1;
    return can;
}

const TileErrors* BlockErrors::find(uint32_t variant, const BlockContents& contents, double seconds)
{
    const BlockContent& content = contents.of(variant);
    const auto known = entries_.find(content.identity);
    const bool isKnown = known != entries_.end();
    const double passed = isKnown && content.isAnimated ? std::abs(seconds - known->second.seconds) : 0.0;
    if (!isKnown || passed > kSeconds) {
        if (!canPredict(isKnown ? &known->second : nullptr)) {
            if (!isKnown)
                return nullptr;
            known->second.frame = frame_;
            return &known->second.shown;
        }
        Entry& entry = entries_[content.identity];
        predict(variant, contents, entry.to);
        entry.from = isKnown && passed <= 4.0 * kSeconds ? entry.shown : entry.to; // after a jump, at once
        entry.shown = entry.from;
        entry.seconds = seconds;
        entry.frame = entry.made = frame_;
        return &entry.shown;
    }
    Entry& entry = known->second;
    entry.frame = frame_;
    if (content.isAnimated)
        entry.shown = errorsBetween(entry.from, entry.to, float(passed / kSeconds));
    return &entry.shown;
}

void BlockErrors::predict(uint32_t variant, const BlockContents& contents, TileErrors& out)
{
    const BlockContent& content = contents.of(variant);
    balls_.clear();
    contents.balls(variant, balls_);
    out = predictTileErrors(balls_, content.radius, content.isColored);
    work_ += out.work;
}

} // namespace fx::render
