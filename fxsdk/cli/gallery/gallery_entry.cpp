#include "fxsdk/cli/gallery/gallery_entry.h"

#include "fxsdk/cli/gallery/gallery_moments.h"
#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/techniques.h"
#include "rendering/image/image.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace fx::cli {
namespace {

constexpr base::Ticks kStep = base::kTicksPerSecond / 60;
constexpr size_t kMostFrames = 5;            ///< measured frames
constexpr double kMostMilliseconds = 1500.0; ///< [ms] after which no further frame is measured

std::string textOf(const char* format, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Elements of the techniques, composition, and how long the effect lasts.
std::vector<std::string> tagsOf(const nlohmann::json& preset, double duration)
{
    std::vector<std::string> tags;
    for (const preset::Technique& technique : preset::techniques()) {
        const auto found = preset.find(technique.presetMember);
        if (found != preset.end() && found->is_array() && !found->empty())
            tags.push_back(std::string(technique.presetMember) + " " + std::to_string(found->size()));
    }
    const std::string composition = preset.value("composition", std::string());
    if (!composition.empty())
        tags.push_back(composition);
    tags.push_back(duration > 0.0 ? textOf("%.3g s", duration) : std::string("no fixed end"));
    return tags;
}

/// Two or more pictures side by side, each reduced so that all of them are as wide as one.
class Strip
{
public:
    Strip(const GalleryOptions& options)
        : count_(options.times), side_(std::max(options.width / std::max(options.times, 1), 1)),
          high_(std::max(options.height * side_ / options.width, 1)), image_{side_ * count_, high_, 3, {}}
    {
        image_.pixels.resize(size_t(image_.width) * size_t(image_.height) * 3);
    }

    /// Puts the mean of the pixels that each pixel of the strip covers.
    void add(const image::Image& picture)
    {
        for (int y = 0; y < high_; ++y)
            for (int x = 0; x < side_; ++x) {
                const int left = x * picture.width / side_, right = (x + 1) * picture.width / side_;
                const int top = y * picture.height / high_, bottom = (y + 1) * picture.height / high_;
                float sum[3] = {0.0f, 0.0f, 0.0f};
                for (int v = top; v < std::max(bottom, top + 1); ++v)
                    for (int u = left; u < std::max(right, left + 1); ++u)
                        for (int c = 0; c < 3; ++c)
                            sum[c] += image::srgbToLinear(picture.at(u, v)[c]);
                const int covered = std::max(right - left, 1) * std::max(bottom - top, 1);
                for (int c = 0; c < 3; ++c)
                    image_.at(added_ * side_ + x, y)[c] = image::linearToSrgb(sum[c] / float(covered));
            }
        ++added_;
    }

    const image::Image& image() const { return image_; }

private:
    int count_, side_, high_;
    int added_ = 0;
    image::Image image_;
};

image::Image withoutAlpha(const Picture& picture)
{
    image::Image result{picture.width, picture.height, 3, {}};
    result.pixels.reserve(picture.pixels.size() / 4 * 3);
    for (size_t i = 0; i + 3 < picture.pixels.size(); i += 4)
        for (size_t c = 0; c < 3; ++c)
            result.pixels.push_back(std::clamp(picture.pixels[i + c], 0.0f, 1.0f));
    return result;
}

base::Result<std::string> pngOf(const image::Image& image)
{
    const auto bytes = image::writePng(image);
    if (!bytes.ok())
        return bytes.status();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

double medianOf(std::vector<double> values)
{
    std::ranges::sort(values);
    return values[values.size() / 2];
}

class EntryMaker
{
public:
    EntryMaker(GalleryEntry& entry, const GalleryOptions& options, const std::function<void()>& drawn)
        : entry_(entry), options_(options), drawn_(drawn), strip_(options)
    {}

    base::Status run()
    {
        scene_file::Preview preview;
        auto scene = sceneOfPreset(entry_.input, &preview);
        if (!scene.ok())
            return scene.status();
        followPresets(*scene);
        describe(*scene, preview);
        const double aspect = double(options_.width) / double(options_.height);
        if (!preview.hasCamera)
            if (base::Status status = frameEffect(*scene, base::toTicks(entry_.time), {}, aspect); !status)
                return status;
        FrameRendererOptions rendererOptions;
        rendererOptions.width = options_.width;
        rendererOptions.height = options_.height;
        rendererOptions.settings = scene->view;
        rendererOptions.settings.toneMap = true;
        rendererOptions.everyFrameIsCut = true;
        auto renderer = FrameRenderer::create(*scene, rendererOptions);
        if (!renderer.ok())
            return renderer.status();
        entry_.renderer = (*renderer)->rendererName();
        return draw(**renderer);
    }

private:
    void describe(const scene_file::SceneFile& scene, const scene_file::Preview& preview)
    {
        const sim::EffectDef& effect = *scene.presets[0].effect;
        const double duration = base::toSeconds(effect.duration);
        const auto preset = nlohmann::json::parse(scene.presets[0].text, nullptr, false, true);
        if (preset.is_object()) {
            entry_.description = preset.value("description", std::string());
            entry_.tags = tagsOf(preset, duration);
        }
        entry_.memory = effect.cost.memory;
        entry_.time = preview.time.value_or(kGalleryTime);
        moments_ = stripMoments(entry_.time, duration, options_.times);
        for (const base::Ticks tick : moments_)
            entry_.times.push_back(base::toSeconds(tick));
    }

    /// All moments in their order: time only moves forward.
    base::Status draw(FrameRenderer& renderer)
    {
        const base::Ticks picture = base::toTicks(entry_.time);
        size_t next = 0;
        for (; next < moments_.size() && moments_[next] < picture; ++next)
            if (base::Status status = addToStrip(renderer, moments_[next]); !status)
                return status;
        if (base::Status status = drawPicture(renderer, picture); !status)
            return status;
        base::Ticks last = picture;
        if (base::Status status =
                measure(renderer, next < moments_.size() ? moments_[next] : picture + 9 * kStep, last);
            !status)
            return status;
        for (; next < moments_.size(); ++next)
            if (base::Status status = addToStrip(renderer, std::max(moments_[next], last)); !status)
                return status;
        if (moments_.empty())
            return {};
        auto png = pngOf(strip_.image());
        if (!png.ok())
            return png.status();
        entry_.strip = std::move(*png);
        return {};
    }

    base::Result<image::Image> drawn(FrameRenderer& renderer, base::Ticks tick)
    {
        if (base::Status status = renderer.render(tick); !status)
            return status;
        const auto layers = renderer.read();
        if (!layers.ok())
            return layers.status();
        if (interruptRequested())
            return interruptedStatus();
        drawn_();
        return withoutAlpha(layers->color);
    }

    base::Status addToStrip(FrameRenderer& renderer, base::Ticks tick)
    {
        const auto image = drawn(renderer, tick);
        if (!image.ok())
            return image.status();
        strip_.add(*image);
        return {};
    }

    base::Status drawPicture(FrameRenderer& renderer, base::Ticks tick)
    {
        const auto image = drawn(renderer, tick);
        if (!image.ok())
            return image.status();
        auto png = pngOf(*image);
        if (!png.ok())
            return png.status();
        entry_.picture = std::move(*png);
        entry_.particles = renderer.counters().scene.particles;
        entry_.textures = renderer.counters().view.textureBytes;
        return {};
    }

    /// Draws the steps that follow the picture, before `end`. If there is no room for one, the costs are
    /// those of the picture itself.
    /// @param ioLast moment of the last frame
    base::Status measure(FrameRenderer& renderer, base::Ticks end, base::Ticks& ioLast)
    {
        std::vector<double> frames, updates;
        double spent = 0.0;
        while (frames.size() < kMostFrames && ioLast + kStep < end && spent < kMostMilliseconds) {
            ioLast += kStep;
            if (base::Status status = renderer.render(ioLast); !status)
                return status;
            if (interruptRequested())
                return interruptedStatus();
            frames.push_back(renderer.counters().millisecondsRender);
            updates.push_back(renderer.counters().millisecondsSimulate);
            spent += frames.back() + updates.back();
        }
        entry_.measured = int(frames.size());
        if (frames.empty()) {
            frames.push_back(renderer.counters().millisecondsRender);
            updates.push_back(renderer.counters().millisecondsSimulate);
        }
        entry_.frameMilliseconds = medianOf(std::move(frames));
        entry_.updateMilliseconds = medianOf(std::move(updates));
        return {};
    }

    GalleryEntry& entry_;
    const GalleryOptions& options_;
    const std::function<void()>& drawn_;
    std::vector<base::Ticks> moments_; ///< of the strip
    Strip strip_;
};

} // namespace

base::Result<GalleryEntry> makeGalleryEntry(const std::string& input, const GalleryOptions& options,
                                            const std::function<void()>& drawn)
{
    GalleryEntry entry;
    entry.input = input;
    if (base::Status status = EntryMaker(entry, options, drawn).run(); !status)
        return status;
    return entry;
}

} // namespace fx::cli
