#include "fxsdk/cli/render/frame_output.h"

#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/ffmpeg_pipe.h"
#include "rendering/exr/exr_encoder.h"
#include "rendering/image/image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fx::cli {
namespace {

/// Display-referred values without alpha: a PNG's alpha would make viewers blend what is already composed.
image::Image withoutAlpha(const Picture& picture)
{
    image::Image result{picture.width, picture.height, 3, {}};
    result.pixels.reserve(picture.pixels.size() / 4 * 3);
    for (size_t i = 0; i + 3 < picture.pixels.size(); i += 4)
        result.pixels.insert(result.pixels.end(),
                             {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]});
    return result;
}

class PngOutput final : public FrameOutput
{
public:
    explicit PngOutput(OutputTarget target) : target_(std::move(target)) {}

    base::Status write(int64_t number, const FrameLayers& layers) override
    {
        const auto bytes = image::writePng(withoutAlpha(layers.color));
        if (!bytes.ok())
            return bytes.status();
        return writeFileAtomically(target_.frame(number),
                                   {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    }

private:
    OutputTarget target_;
};

/// All frames in one picture, row by row; it is written when the last has come.
class SheetOutput final : public FrameOutput
{
public:
    explicit SheetOutput(const RenderPlan& plan)
        : target_(plan.output), columns_(plan.sheetColumns()), sheet_{plan.width * plan.sheetColumns(),
                                                                      plan.height * plan.sheetRows(),
                                                                      3,
                                                                      {}}
    {
        sheet_.pixels.resize(size_t(sheet_.width) * size_t(sheet_.height) * 3);
    }

    base::Status write(int64_t number, const FrameLayers& layers) override
    {
        const image::Image picture = withoutAlpha(layers.color);
        const size_t row = size_t(picture.width) * 3;
        const size_t left = size_t(number % columns_) * row;
        const size_t top = size_t(number / columns_) * size_t(picture.height);
        for (size_t y = 0; y < size_t(picture.height); ++y)
            std::copy_n(&picture.pixels[y * row], row,
                        &sheet_.pixels[(top + y) * size_t(sheet_.width) * 3 + left]);
        return {};
    }

    base::Status finish() override
    {
        const auto bytes = image::writePng(sheet_);
        return bytes.ok() ? writeFileAtomically(target_.path,
                                                {reinterpret_cast<const char*>(bytes->data()), bytes->size()})
                          : bytes.status();
    }

private:
    OutputTarget target_;
    int64_t columns_;
    image::Image sheet_;
};

class ExrOutput final : public FrameOutput
{
public:
    ExrOutput(OutputTarget target, float exposureEv100)
        : target_(std::move(target)), exposureEv100_(exposureEv100)
    {}

    base::Status write(int64_t number, const FrameLayers& layers) override
    {
        using render::ExrPrecision;
        render::ExrImage image{layers.color.width, layers.color.height, {}, 1.2f * std::exp2(exposureEv100_)};
        render::addRgba(image, "", layers.color.pixels, ExrPrecision::Float);
        render::addRgba(image, "background", layers.background.pixels, ExrPrecision::Float);
        const char* const names[] = {"fire", "smoke", "dust"};
        for (size_t i = 0; i < layers.media.size(); ++i)
            render::addRgba(image, names[i], layers.media[i].pixels, ExrPrecision::Float);
        render::addPlane(image, "depth.Z", layers.depth.pixels, ExrPrecision::Float);
        render::addPlane(image, "opticalDepth.Y", layers.opticalDepth.pixels, ExrPrecision::Float);
        addOutputs(image, layers.outputs);
        const auto bytes = render::encodeExr(image);
        return bytes.ok() ? writeFileAtomically(target_.frame(number), *bytes) : bytes.status();
    }

private:
    static void addOutputs(render::ExrImage& io, const FrameLayers::Outputs& outputs)
    {
        using render::ExrPrecision;
        const auto add = [&](const char* name, const Picture& from, size_t channel, ExrPrecision precision) {
            if (!from.pixels.empty())
                io.channels.push_back({name, from.pixels, channel, size_t(from.channels), precision});
        };
        add("id", outputs.instance, 0, ExrPrecision::Whole);
        add("motion.X", outputs.motion, 0, ExrPrecision::Float);
        add("motion.Y", outputs.motion, 1, ExrPrecision::Float);
        add("firstDepth.Z", outputs.firstDepth, 0, ExrPrecision::Float);
        add("meanDepth.Z", outputs.meanDepth, 0, ExrPrecision::Float);
    }

    OutputTarget target_;
    float exposureEv100_;
};

class VideoOutput final : public FrameOutput
{
public:
    base::Status start(const RenderPlan& plan)
    {
        return pipe_.start(plan.output.path, plan.width, plan.height, plan.framesPerSecond);
    }
    base::Status write(int64_t, const FrameLayers& layers) override
    {
        const image::Image picture = withoutAlpha(layers.color);
        std::vector<uint8_t> bytes(picture.pixels.size());
        std::transform(picture.pixels.begin(), picture.pixels.end(), bytes.begin(), [](float value) {
            return value > 0.0f ? uint8_t(std::lround(std::min(value, 1.0f) * 255.0f))
                                : uint8_t(0); // NaN is 0
        });
        return pipe_.write(bytes);
    }
    base::Status finish() override { return pipe_.finish(); }

private:
    FfmpegPipe pipe_;
};

base::Status checkFolder(const std::filesystem::path& file)
{
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code error;
    if (std::filesystem::is_directory(folder, error))
        return {};
    return {base::Code::Io, "cannot create " + file.string() + ": there is no folder " + folder.string()};
}

} // namespace

base::Result<std::unique_ptr<FrameOutput>> FrameOutput::create(const RenderPlan& plan, float exposureEv100)
{
    if (base::Status status = checkFolder(plan.output.path); !status)
        return status;
    switch (plan.output.kind) {
    case OutputKind::Png:
        return plan.isSheet ? std::unique_ptr<FrameOutput>(new SheetOutput(plan))
                            : std::unique_ptr<FrameOutput>(new PngOutput(plan.output));
    case OutputKind::Exr:
        return std::unique_ptr<FrameOutput>(new ExrOutput(plan.output, exposureEv100));
    case OutputKind::Mp4:
        break;
    }
    auto video = std::make_unique<VideoOutput>();
    if (base::Status status = video->start(plan); !status)
        return status;
    return std::unique_ptr<FrameOutput>(std::move(video));
}

} // namespace fx::cli
